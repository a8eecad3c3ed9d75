#include "app/scene/rom_layer.h"

#include <vtkLineSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include "app/scene/rom_patch.h"
#include "app/scene/vtk_convert.h"

namespace sinew {
namespace {

void plain(vtkActor& actor, const Rgb& colour) {
  actor.GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor.GetProperty()->SetAmbient(0.6);
  actor.GetProperty()->SetDiffuse(0.4);
}

}  // namespace

RomLayer::RomLayer(vtkRenderer& renderer) {
  plain(*border_, {0.30, 0.02, 0.05});
  plain(*shaft_, palette::kBlue);
  plain(*tip_, palette::kBlue);
  setGraticuleColour(0.55);
  auto* look = patch_->GetProperty();
  look->SetAmbient(0.45);  // colours are read: little shading
  look->SetDiffuse(0.55);
  for (vtkActor* actor : {patch_.Get(), border_.Get(), graticule_.Get(), shaft_.Get(), tip_.Get()}) {
    actor->PickableOff();
    renderer.AddActor(actor);
  }
  setVisible(false);
}

void RomLayer::draw(const RomMap& map, double radius_m, double widest_rad) {
  radius_m_ = radius_m;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(romPatch(map, radius_m, widest_rad));
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray("colour");
  patch_->SetMapper(mapper);
  drawTube(*border_, romBorder(map, radius_m), 0.010 * radius_m);
  drawTube(*graticule_, romGraticule(map.frame, radius_m), 0.003 * radius_m);
}

void RomLayer::setPose(const RigidTransform& X_WJ, const Eigen::Vector3d& shaft_J) {
  const auto matrix = toMatrix(X_WJ);
  const Eigen::Vector3d end = 1.12 * radius_m_ * shaft_J;
  vtkNew<vtkLineSource> line;
  line->SetPoint1(0, 0, 0);
  line->SetPoint2(end.x(), end.y(), end.z());
  line->Update();
  drawTube(*shaft_, line->GetOutput(), 0.022 * radius_m_);
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(end.x(), end.y(), end.z());
  ball->SetRadius(0.05 * radius_m_);
  ball->SetThetaResolution(20);
  ball->SetPhiResolution(14);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  tip_->SetMapper(mapper);
  for (vtkActor* actor : {patch_.Get(), border_.Get(), graticule_.Get(), shaft_.Get(), tip_.Get()})
    actor->SetUserMatrix(matrix);
}

void RomLayer::setVisible(bool visible) {
  for (vtkActor* actor : {patch_.Get(), border_.Get(), graticule_.Get(), shaft_.Get(), tip_.Get()})
    actor->SetVisibility(visible);
}

void RomLayer::setGraticuleColour(double grey) {
  plain(*graticule_, {grey, grey, grey});
}

}  // namespace sinew
