#include "app/scene/rom_handle_layer.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <cmath>
#include <numbers>

#include "app/scene/palette.h"
#include "app/scene/rom_patch.h"
#include "app/scene/vtk_convert.h"

namespace sinew {
namespace {

constexpr double kAbove = 1.006;  // of the radius: lines lie on the patch, not in it

void plain(vtkActor& actor, const Rgb& colour) {
  actor.GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor.GetProperty()->SetAmbient(0.7);
  actor.GetProperty()->SetDiffuse(0.3);
  actor.PickableOff();
  actor.VisibilityOff();
}

void drawBall(vtkActor& actor, const Eigen::Vector3d& p, double radius_m) {
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(p.x(), p.y(), p.z());
  ball->SetRadius(radius_m);
  ball->SetThetaResolution(24);
  ball->SetPhiResolution(16);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  actor.SetMapper(mapper);
}

}  // namespace

RomHandleLayer::RomHandleLayer(vtkRenderer& renderer) {
  plain(*outline_, palette::kBlue);
  plain(*circle_, palette::kGreen);
  plain(*centre_, palette::kGreen);
  plain(*border_, palette::kGreen);
  for (vtkActor* actor : {outline_.Get(), circle_.Get(), centre_.Get(), border_.Get()}) renderer.AddActor(actor);
}

void RomHandleLayer::setOutline(const std::optional<RomMap>& map, double radius_m) {
  outline_->SetVisibility(map.has_value());
  if (map) drawTube(*outline_, romBorder(*map, kAbove * radius_m), 0.011 * radius_m);
}

void RomHandleLayer::draw(const Eigen::Vector3d& centre_J, double cone_rad, const Eigen::Vector3d& border_J,
                          double radius_m) {
  constexpr int kPieces = 96;
  const Eigen::Vector3d e1 = centre_J.unitOrthogonal(), e2 = centre_J.cross(e1);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(kPieces + 1);
  for (int i = 0; i <= kPieces; ++i) {
    const double a = 2 * std::numbers::pi * i / kPieces;
    const Eigen::Vector3d p =
        kAbove * radius_m *
        (std::cos(cone_rad) * centre_J + std::sin(cone_rad) * (std::cos(a) * e1 + std::sin(a) * e2));
    lines->InsertCellPoint(points->InsertNextPoint(p.data()));
  }
  vtkNew<vtkPolyData> circle;
  circle->SetPoints(points);
  circle->SetLines(lines);
  drawTube(*circle_, circle, 0.014 * radius_m);
  drawBall(*centre_, radius_m * centre_J, 0.055 * radius_m);
  drawBall(*border_, radius_m * border_J, 0.055 * radius_m);
  for (vtkActor* actor : {circle_.Get(), centre_.Get(), border_.Get()}) actor->VisibilityOn();
}

void RomHandleLayer::hide() {
  for (vtkActor* actor : {circle_.Get(), centre_.Get(), border_.Get()}) actor->VisibilityOff();
}

}  // namespace sinew
