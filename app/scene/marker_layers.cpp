#include "app/scene/marker_layers.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTubeFilter.h>

#include "app/scene/palette.h"

namespace sinew {
namespace {

void paint(vtkActor& actor, const Rgb& colour) {
  actor.GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor.GetProperty()->SetAmbient(0.45);  // markers are read, not looked at: little shading
  actor.GetProperty()->SetDiffuse(0.6);
}

/// Draws in front of everything at the same place: the depth is shifted by more than a body.
void showThroughBones(vtkMapper& mapper) {
  mapper.SetResolveCoincidentTopologyToPolygonOffset();
  mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0, -66000);
}

void tubes(vtkPolyData& lines, vtkActor& actor, double radius_m) {
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(&lines);
  tube->SetRadius(radius_m);
  tube->SetNumberOfSides(12);
  tube->CappingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tube->GetOutputPort());
  showThroughBones(*mapper);
  actor.SetMapper(mapper);
}

void balls(vtkPolyData& points, vtkGlyph3D& glyphs, vtkActor& actor, double radius_m, bool on_top) {
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius_m);
  sphere->SetThetaResolution(16);
  sphere->SetPhiResolution(12);
  glyphs.SetInputData(&points);
  glyphs.SetSourceConnection(sphere->GetOutputPort());
  glyphs.ScalingOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(glyphs.GetOutputPort());
  if (on_top) showThroughBones(*mapper);
  actor.SetMapper(mapper);
}

void setLines(vtkPolyData& data, const std::vector<std::vector<Eigen::Vector3d>>& lines) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& line : lines) {
    cells->InsertNextCell(int(line.size()));
    for (const auto& p : line) cells->InsertCellPoint(points->InsertNextPoint(p.data()));
  }
  data.Initialize();
  data.SetPoints(points);
  data.SetLines(cells);
  data.Modified();
}

void setPoints(vtkPolyData& data, const std::vector<Eigen::Vector3d>& p_W) {
  vtkNew<vtkPoints> points;
  for (const auto& p : p_W) points->InsertNextPoint(p.data());
  data.Initialize();
  data.SetPoints(points);
  data.Modified();
}

int segmentNamed(const Skeleton& skeleton, const std::string& name) {
  for (std::size_t i = 0; i < skeleton.segments.size(); ++i)
    if (skeleton.segments[i].name == name) return int(i);
  return -1;
}

}  // namespace

std::vector<LegAxes> legAxes(const Skeleton& skeleton, const std::vector<RigidTransform>& X_WB) {
  std::vector<LegAxes> legs;
  for (const std::string side : {"_r", "_l"}) {
    const int femur = segmentNamed(skeleton, "femur" + side), tibia = segmentNamed(skeleton, "tibia" + side),
              foot = segmentNamed(skeleton, "foot" + side);
    if (femur < 0 || tibia < 0 || foot < 0) continue;
    legs.push_back({X_WB[femur].translation(), X_WB[tibia].translation(), X_WB[foot].translation()});
  }
  return legs;
}

AxesLayer::AxesLayer(vtkRenderer& renderer) {
  tubes(*bone_axes_.data, *bone_axes_.actor, 0.0028);
  tubes(*load_line_.data, *load_line_.actor, 0.0016);
  balls(*centres_.data, *balls_, *centres_.actor, 0.0075, true);
  paint(*bone_axes_.actor, palette::kVermilion);
  paint(*load_line_.actor, palette::kBlue);
  paint(*centres_.actor, palette::kVermilion);
  for (auto* lines : {&bone_axes_, &load_line_, &centres_}) {
    lines->actor->PickableOff();
    renderer.AddActor(lines->actor);
  }
}

void AxesLayer::draw(const std::vector<LegAxes>& legs) {
  std::vector<std::vector<Eigen::Vector3d>> bone_axes, load_lines;
  std::vector<Eigen::Vector3d> centres;
  for (const auto& leg : legs) {
    bone_axes.push_back({leg.hip_W, leg.knee_W});
    bone_axes.push_back({leg.knee_W, leg.ankle_W});
    load_lines.push_back({leg.hip_W, leg.ankle_W});
    centres.insert(centres.end(), {leg.hip_W, leg.knee_W, leg.ankle_W});
  }
  setLines(*bone_axes_.data, bone_axes);
  setLines(*load_line_.data, load_lines);
  setPoints(*centres_.data, centres);
}

void AxesLayer::setVisible(bool visible) {
  for (auto* lines : {&bone_axes_, &load_line_, &centres_}) lines->actor->SetVisibility(visible);
}

LandmarkLayer::LandmarkLayer(vtkRenderer& renderer) {
  balls(*data_, *balls_, *actor_, 0.0045, false);
  paint(*actor_, palette::kGreen);
  renderer.AddActor(actor_);
}

void LandmarkLayer::draw(const Skeleton& skeleton, const std::vector<RigidTransform>& X_WB) {
  p_W_.clear();
  for (const auto& landmark : skeleton.landmarks) p_W_.push_back(X_WB[landmark.segment] * landmark.p_BL);
  setPoints(*data_, p_W_);
}

int LandmarkLayer::nearest(const Eigen::Vector3d& p_W) const {
  int best = -1;
  for (std::size_t i = 0; i < p_W_.size(); ++i)
    if (best < 0 || (p_W_[i] - p_W).squaredNorm() < (p_W_[best] - p_W).squaredNorm()) best = int(i);
  return best;
}

}  // namespace sinew
