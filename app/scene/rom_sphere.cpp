#include "app/scene/rom_sphere.h"

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkLightKit.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSphereSource.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/scene/rom_handle_layer.h"
#include "app/scene/rom_layer.h"
#include "app/scene/rom_patch.h"

namespace sinew {
namespace {

constexpr double kRadius = 1, kWordRadius = 1.27;

struct NamedDirection {
  const char* name;
  std::array<double, 3> direction_J;
};
constexpr NamedDirection kDirections[] = {{"front", {1, 0, 0}}, {"back", {-1, 0, 0}}, {"up", {0, 1, 0}},
                                          {"down", {0, -1, 0}}, {"right", {0, 0, 1}}, {"left", {0, 0, -1}}};

void addColourBar(vtkRenderer& renderer, double widest_rad, bool dark, int font_px) {
  vtkNew<vtkLookupTable> table;
  const double widest_deg = widest_rad * 180 / std::numbers::pi;
  table->SetNumberOfTableValues(128);
  table->SetTableRange(0, widest_deg);
  for (int i = 0; i < 128; ++i) {
    const Rgb c = romColour(i / 127.0, 1);
    table->SetTableValue(i, c.r, c.g, c.b, 1);
  }
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  bar->SetTitle("twist range, degrees");
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%.0f");
  bar->SetOrientationToHorizontal();
  bar->SetPosition(0.12, 0.015);
  bar->SetWidth(0.76);
  bar->SetHeight(0.12);
  bar->UnconstrainedFontSizeOn();
  for (auto* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
    text->SetFontSize(font_px);
    text->ItalicOff();
    text->ShadowOff();
    text->BoldOff();
    const double grey = dark ? 0.9 : 0.15;
    text->SetColor(grey, grey, grey);
  }
  renderer.AddActor2D(bar);
}

}  // namespace

struct RomSphereScene::Parts {
  explicit Parts(vtkRenderer& r) : renderer{r}, layer{r}, handle_layer{r} {}
  vtkRenderer& renderer;
  RomLayer layer;
  vtkNew<vtkActor> globe;
  std::array<vtkNew<vtkBillboardTextActor3D>, std::size(kDirections)> words;
  RomHandleLayer handle_layer;
  std::optional<RomHandles> handles;
  Eigen::Vector3d shaft_J = -Eigen::Vector3d::UnitY();
  int side = 1;
  unsigned long observer = 0;

  ~Parts() { renderer.RemoveObserver(observer); }
  /// The sphere would cut words that lie behind it in two.
  void hideWordsBehind() {
    const double* towards = renderer.GetActiveCamera()->GetDirectionOfProjection();
    for (std::size_t i = 0; i < std::size(kDirections); ++i) {
      const auto& d = kDirections[i].direction_J;
      words[i]->SetVisibility(d[0] * towards[0] + d[1] * towards[1] + d[2] * towards[2] < 0.25);
    }
  }
};

RomSphereScene::RomSphereScene(vtkRenderer& renderer) : parts_{std::make_unique<Parts>(renderer)} {
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightIntensity(0.9);
  lights->AddLightsToRenderer(&renderer);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.985 * kRadius);
  sphere->SetThetaResolution(72);
  sphere->SetPhiResolution(48);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  parts_->globe->SetMapper(mapper);
  parts_->globe->PickableOff();
  parts_->globe->GetProperty()->SetAmbient(0.35);
  parts_->globe->GetProperty()->SetDiffuse(0.6);
  renderer.AddActor(parts_->globe);
  for (std::size_t i = 0; i < std::size(kDirections); ++i) {
    auto& word = *parts_->words[i];
    const auto& d = kDirections[i].direction_J;
    word.SetInput(kDirections[i].name);
    word.SetPosition(kWordRadius * d[0], kWordRadius * d[1], kWordRadius * d[2]);
    word.GetTextProperty()->SetJustificationToCentered();
    word.GetTextProperty()->SetVerticalJustificationToCentered();
    word.GetTextProperty()->SetFontSize(13);
    renderer.AddActor(&word);
  }
  setBackdrop(Backdrop::White);
  vtkNew<vtkCallbackCommand> before_drawing;
  before_drawing->SetClientData(parts_.get());
  before_drawing->SetCallback(
      [](vtkObject*, unsigned long, void* parts, void*) { static_cast<Parts*>(parts)->hideWordsBehind(); });
  parts_->observer = renderer.AddObserver(vtkCommand::StartEvent, before_drawing);
}
RomSphereScene::~RomSphereScene() = default;

void RomSphereScene::setMap(const RomMap& map, double widest_rad) {
  parts_->side = sideSign(map.joint);
  parts_->layer.draw(map, kRadius, widest_rad);
  parts_->layer.setVisible(true);
  setShaft(map.frame.shaft_J);
}

void RomSphereScene::setShaft(const Eigen::Vector3d& shaft_J) {
  parts_->shaft_J = shaft_J;
  parts_->layer.setPose(RigidTransform::Identity(), shaft_J);
}

void RomSphereScene::setOutline(const std::optional<RomMap>& map) {
  parts_->handle_layer.setOutline(map, kRadius);
}

void RomSphereScene::setHandles(const std::optional<RomHandles>& handles) {
  parts_->handles = handles;
  if (handles)
    parts_->handle_layer.draw(handles->centre_J, handles->cone_rad, borderHandle_J(), kRadius);
  else
    parts_->handle_layer.hide();
}

Eigen::Vector3d RomSphereScene::borderHandle_J() const {
  if (!parts_->handles) return parts_->shaft_J;
  const auto& [centre_J, cone_rad] = *parts_->handles;
  // Of all points of the border the one that lies most to the viewer's left and below: away from the words.
  vtkCamera* camera = parts_->renderer.GetActiveCamera();
  const Eigen::Vector3d towards = -Eigen::Map<const Eigen::Vector3d>{camera->GetDirectionOfProjection()};
  const Eigen::Vector3d up = Eigen::Map<const Eigen::Vector3d>{camera->GetViewUp()};
  const Eigen::Vector3d wish = 0.8 * towards - 0.6 * up.cross(towards) - 0.45 * up;
  Eigen::Vector3d across = wish - wish.dot(centre_J) * centre_J;
  if (across.norm() < 1e-6) across = centre_J.unitOrthogonal();
  return std::cos(cone_rad) * centre_J + std::sin(cone_rad) * across.normalized();
}

Eigen::Vector3d RomSphereScene::directionAt(double x_px, double y_px) const {
  vtkRenderer& r = parts_->renderer;
  r.SetDisplayPoint(x_px, y_px, 0);
  r.DisplayToWorld();
  double p[4];
  r.GetWorldPoint(p);
  const Eigen::Vector3d near_J = Eigen::Vector3d{p[0], p[1], p[2]} / p[3];
  const Eigen::Vector3d along = Eigen::Map<const Eigen::Vector3d>{r.GetActiveCamera()->GetDirectionOfProjection()};
  const Eigen::Vector3d across = near_J - near_J.dot(along) * along;  // parallel projection
  const double rest = kRadius * kRadius - across.squaredNorm();
  if (rest <= 0) return across.normalized();
  return (across - std::sqrt(rest) * along).normalized();
}

Eigen::Vector2d RomSphereScene::pixelOf(const Eigen::Vector3d& direction_J) const {
  vtkRenderer& r = parts_->renderer;
  const Eigen::Vector3d p = kRadius * direction_J;
  r.SetWorldPoint(p.x(), p.y(), p.z(), 1);
  r.WorldToDisplay();
  double d[3];
  r.GetDisplayPoint(d);
  return {d[0], d[1]};
}

void RomSphereScene::setBackdrop(Backdrop backdrop) {
  const bool dark = backdrop == Backdrop::Dark;
  vtkRenderer& r = parts_->renderer;
  r.SetGradientBackground(dark);
  if (dark) {
    r.SetBackground(0.075, 0.090, 0.110);
    r.SetBackground2(0.200, 0.230, 0.265);
  } else {
    r.SetBackground(1, 1, 1);
  }
  const double globe = dark ? 0.36 : 0.93, word = dark ? 0.92 : 0.2, ground = dark ? 0.1 : 1;
  parts_->globe->GetProperty()->SetColor(globe, globe, globe);
  parts_->layer.setGraticuleColour(0.62);
  for (auto& w : parts_->words) {
    w->GetTextProperty()->SetColor(word, word, word);
    w->GetTextProperty()->SetBackgroundColor(ground, ground, ground);  // legible over any colour
    w->GetTextProperty()->SetBackgroundOpacity(0.75);
  }
}

void RomSphereScene::setFontSize(int size_px) {
  for (auto& word : parts_->words) word->GetTextProperty()->SetFontSize(size_px);
}

void RomSphereScene::lookFromTheFront() {
  vtkRenderer& r = parts_->renderer;
  const Eigen::Vector3d out = Eigen::Vector3d{0.80, 0.10, 0.60 * parts_->side}.normalized() * 4;
  vtkCamera* camera = r.GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(out.data());
  camera->SetViewUp(0, 1, 0);
  camera->SetParallelScale(1.48 * kRadius);  // the words need room
  parts_->hideWordsBehind();
  r.ResetCameraClippingRange();
}

Eigen::Vector3d shaftDirection(const Model& model, const RomMap& map, const Posture& posture) {
  const Joint& joint = model.skeleton.joints[std::size_t(model.skeleton.jointIndex(map.joint))];
  return rotationFromVector<double>(posture.segment<3>(joint.first_coordinate)) * map.frame.shaft_J;
}

RgbImage renderRomSphere(const RomMap& map, const RomPicture& picture) {
  double widest_rad = picture.widest_rad;
  if (!(widest_rad > 0))
    for (int polar = 0; polar < RomMap::kPolars; ++polar)
      for (int azimuth = 0; azimuth < RomMap::kAzimuths; ++azimuth)
        widest_rad = std::max(widest_rad, map.twistWidth_rad(polar, azimuth));
  const auto compose = [&](vtkRenderer& renderer) {
    RomSphereScene scene{renderer};
    scene.setBackdrop(picture.backdrop);
    scene.setMap(map, widest_rad);
    if (picture.shaft_J) scene.setShaft(*picture.shaft_J);
    scene.lookFromTheFront();
    scene.setOutline(picture.outline);
    scene.setHandles(picture.handles);
    const int font_px = std::max(10, picture.width_px * picture.quality.supersampling / 30);
    scene.setFontSize(font_px);
    if (picture.colour_bar) {
      addColourBar(renderer, widest_rad, picture.backdrop == Backdrop::Dark, font_px);
      renderer.GetActiveCamera()->SetWindowCenter(0, -0.16);  // room for the bar below
      renderer.GetActiveCamera()->SetParallelScale(1.2 * renderer.GetActiveCamera()->GetParallelScale());
    }
  };
  return renderOffscreen(picture.width_px, picture.height_px, compose, picture.quality);
}

}  // namespace sinew
