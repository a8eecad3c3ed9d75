#include "app/scene/model_scene.h"

#include <vtkCamera.h>
#include <vtkCellPicker.h>
#include <vtkLightKit.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <numeric>

#include "app/scene/bone_layer.h"
#include "app/scene/marker_layers.h"
#include "app/scene/muscle_layer.h"
#include "app/scene/rom_layer.h"
#include "app/scene/rom_sphere.h"

namespace sinew {
namespace {

/// Where the camera stands, seen from the body, and what is up in its picture.
Eigen::Vector3d viewpoint(StandardView view) {
  switch (view) {
    case StandardView::Front:
      return Eigen::Vector3d::UnitX();
    case StandardView::Back:
      return -Eigen::Vector3d::UnitX();
    case StandardView::Right:
      return Eigen::Vector3d::UnitZ();
    case StandardView::Left:
      return -Eigen::Vector3d::UnitZ();
    case StandardView::Oblique:
      return Eigen::Vector3d{0.80, 0.18, 0.57}.normalized();
  }
  return Eigen::Vector3d::UnitX();
}

}  // namespace

Eigen::Matrix3d viewAxes(StandardView view) {
  Eigen::Matrix3d axes;
  axes.col(2) = viewpoint(view);
  axes.col(0) = Eigen::Vector3d::UnitY().cross(axes.col(2)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

namespace {

void lightLikeAStudio(vtkRenderer& renderer) {
  vtkNew<vtkLightKit> lights;  // they stand with the camera: every view is lit alike
  lights->SetKeyLightIntensity(0.92);
  lights->SetKeyLightAngle(38, -28);
  lights->SetKeyLightWarmth(0.55);
  lights->SetFillLightWarmth(0.48);
  lights->SetKeyToFillRatio(2.8);
  lights->SetKeyToHeadRatio(3.2);
  lights->SetKeyToBackRatio(3.5);
  lights->AddLightsToRenderer(&renderer);
}

/// Most of the length of the bone, so that the patch shows where its end can go; to the next joint, or a hand's
/// length.
double romRadius_m(const Skeleton& skeleton, const std::string& joint_name) {
  constexpr double kShare = 0.55, kLeast_m = 0.07, kMost_m = 0.24;
  const Joint& joint = skeleton.joints[std::size_t(skeleton.jointIndex(joint_name))];
  double length_m = 0;
  for (const auto& next : skeleton.joints)
    if (next.parent == joint.child) length_m = std::max(length_m, next.X_PJ.translation().norm());
  return std::clamp(kShare * length_m, kLeast_m, kMost_m);
}

}  // namespace

struct ModelScene::Parts {
  explicit Parts(vtkRenderer& r) : renderer{r}, bones{r}, muscles{r}, axes{r}, landmarks{r}, rom_layer{r} {}

  void requireModel() const { require(model != nullptr, "the scene has no model yet"); }

  void drawMuscles() {
    if (!model) return;
    muscles.draw(model->musculature, shown, X_WB, [this](int unit) { return colourOf(unit); });
    outlineSelected();
  }
  void outlineSelected() {
    const auto unit = std::ranges::find(model->musculature.units, selected, &MusculotendonUnit::name);
    muscles.outline(unit == model->musculature.units.end() ? nullptr : &*unit, X_WB);
  }
  /// The sphere stands about the joint and turns with the parent.
  void placeRom() {
    rom_layer.setVisible(rom && rom_visible);
    if (!rom) return;
    const Joint& joint = model->skeleton.joints[std::size_t(model->skeleton.jointIndex(rom->joint))];
    const RigidTransform X_WP = joint.parent < 0 ? RigidTransform::Identity() : X_WB[std::size_t(joint.parent)];
    rom_layer.setPose(X_WP * joint.X_PJ, shaftDirection(*model, *rom, posture));
  }
  Rgb colourOf(int unit) const {
    const auto& u = model->musculature.units[unit];
    if (!scalars && !selected.empty() && u.name == selected) return palette::kYellow;
    if (!scalars) return groupColour(u.group);
    const auto value = scalars->by_unit.find(u.name);
    if (value == scalars->by_unit.end()) return palette::kGrey;
    const double span = scalars->high - scalars->low;
    const double t = span != 0 ? (value->second - scalars->low) / span : 0.5;
    return scalars->diverging ? divergingColour(t) : sequentialColour(t);
  }

  vtkRenderer& renderer;
  BoneLayer bones;
  MuscleLayer muscles;
  AxesLayer axes;
  LandmarkLayer landmarks;
  RomLayer rom_layer;
  std::optional<RomMap> rom;
  bool rom_visible = true;
  Posture posture;
  std::shared_ptr<const Model> model;
  std::vector<RigidTransform> X_WB;
  std::vector<int> shown;  ///< units
  std::optional<MuscleScalars> scalars;
  std::string selected;
};

ModelScene::ModelScene(vtkRenderer& renderer) : parts_{std::make_unique<Parts>(renderer)} {
  lightLikeAStudio(renderer);
  setBackdrop(Backdrop::White);
  setVisible(SceneLayer::Landmarks, false);
}
ModelScene::~ModelScene() = default;

void ModelScene::setModel(std::shared_ptr<const Model> model) {
  require(model != nullptr, "setModel: no model");
  parts_->model = std::move(model);
  parts_->bones.setBones(parts_->model->bones);
  parts_->X_WB.clear();
  setRom(std::nullopt);
  setShownMuscles(std::nullopt);
  setPosture(zeroPosture(parts_->model->skeleton));
}

void ModelScene::setPosture(const Posture& q) {
  parts_->requireModel();
  const auto& skeleton = parts_->model->skeleton;
  require(q.size() == skeleton.coordinateCount(), "setPosture: another number of coordinates");
  parts_->X_WB = segmentPoses(skeleton, q);
  parts_->posture = q;
  parts_->bones.setPoses(parts_->X_WB);
  parts_->axes.draw(legAxes(skeleton, parts_->X_WB));
  parts_->landmarks.draw(skeleton, parts_->X_WB);
  parts_->drawMuscles();
  parts_->placeRom();
}

void ModelScene::show(const Posture& q, const std::string& selected, const std::optional<MuscleScalars>& scalars) {
  parts_->scalars = scalars;
  if (selected != parts_->selected) parts_->bones.select(selected);
  parts_->bones.setColour(scalars ? palette::kQuietBone : palette::kBone);
  parts_->selected = selected;
  setPosture(q);
}

void ModelScene::setVisible(SceneLayer layer, bool visible) {
  switch (layer) {
    case SceneLayer::Bones:
      return parts_->bones.setVisible(visible);
    case SceneLayer::Muscles:
      return parts_->muscles.setVisible(visible);
    case SceneLayer::MechanicalAxes:
      return parts_->axes.setVisible(visible);
    case SceneLayer::Landmarks:
      return parts_->landmarks.setVisible(visible);
    case SceneLayer::RomSphere:
      parts_->rom_visible = visible;
      return parts_->rom_layer.setVisible(visible && parts_->rom);
  }
}

void ModelScene::setBackdrop(Backdrop backdrop) {
  vtkRenderer& r = parts_->renderer;
  const bool dark = backdrop == Backdrop::Dark;
  r.SetGradientBackground(dark);
  if (dark) {
    r.SetBackground(0.075, 0.090, 0.110);
    r.SetBackground2(0.200, 0.230, 0.265);
  } else {
    r.SetBackground(1, 1, 1);
  }
}

void ModelScene::setBoneOpacity(double opacity) {
  parts_->bones.setOpacity(std::clamp(opacity, 0.0, 1.0));
}

void ModelScene::setShownMuscles(std::optional<std::vector<std::string>> units) {
  parts_->requireModel();
  const auto& musculature = parts_->model->musculature;
  parts_->shown.clear();
  if (units) {
    for (const auto& name : *units) parts_->shown.push_back(musculature.unitIndex(name));
  } else {
    parts_->shown.resize(musculature.units.size());
    std::iota(parts_->shown.begin(), parts_->shown.end(), 0);
  }
  if (!parts_->X_WB.empty()) parts_->drawMuscles();
}

void ModelScene::colourMusclesByGroup() {
  parts_->scalars.reset();
  parts_->drawMuscles();
}

void ModelScene::colourMusclesBy(const MuscleScalars& scalars) {
  parts_->scalars = scalars;
  parts_->drawMuscles();
}

void ModelScene::setRom(const std::optional<RomMap>& map, double widest_rad) {
  parts_->rom = map;
  if (map) {
    parts_->requireModel();
    parts_->rom_layer.draw(*map, romRadius_m(parts_->model->skeleton, map->joint), widest_rad);
  }
  parts_->placeRom();
}

void ModelScene::select(const std::string& name) {
  parts_->selected = name;
  parts_->bones.select(name);
  parts_->drawMuscles();
}

std::optional<ScenePick> ModelScene::pick(double x_px, double y_px) const {
  vtkNew<vtkCellPicker> picker;
  picker->SetTolerance(0.0005);
  if (!parts_->model || !picker->Pick(x_px, y_px, 0, &parts_->renderer)) return std::nullopt;
  const vtkProp* actor = picker->GetActor();
  ScenePick found;
  picker->GetPickPosition(found.p_W.data());
  if (parts_->landmarks.draws(actor)) {
    found.layer = SceneLayer::Landmarks;
    found.name = parts_->model->skeleton.landmarks[parts_->landmarks.nearest(found.p_W)].name;
  } else if (parts_->muscles.draws(actor)) {
    const int unit = parts_->muscles.unitOfCell(picker->GetCellId());
    if (unit < 0) return std::nullopt;
    found.layer = SceneLayer::Muscles;
    found.name = parts_->model->musculature.units[unit].name;
  } else {
    found.name = parts_->bones.nameOf(actor);
    if (found.name.empty()) return std::nullopt;
  }
  return found;
}

void ModelScene::lookFrom(StandardView view) {
  vtkRenderer& r = parts_->renderer;
  double bounds[6];
  r.ComputeVisiblePropBounds(bounds);
  if (!vtkMath::AreBoundsInitialized(bounds)) return;
  const Eigen::Vector3d lo{bounds[0], bounds[2], bounds[4]}, hi{bounds[1], bounds[3], bounds[5]};
  const Eigen::Vector3d half = (hi - lo) / 2;
  const Eigen::Matrix3d R_WC = viewAxes(view);
  const double half_width = half.dot(R_WC.col(0).cwiseAbs()), half_height = half.dot(R_WC.col(1).cwiseAbs());
  constexpr double kMargin = 1.03;
  const int* size = r.GetVTKWindow() ? r.GetVTKWindow()->GetSize() : nullptr;
  const double aspect = size && size[0] > 0 && size[1] > 0 ? double(size[0]) / size[1] : 1.0;
  lookAt(view, (lo + hi) / 2, kMargin * std::max(half_height, half_width / aspect));
}

void ModelScene::fitAll() {
  vtkRenderer& r = parts_->renderer;
  double bounds[6];
  r.ComputeVisiblePropBounds(bounds);
  if (!vtkMath::AreBoundsInitialized(bounds)) return;
  vtkCamera* camera = r.GetActiveCamera();
  const Eigen::Vector3d towards = -Eigen::Map<const Eigen::Vector3d>{camera->GetDirectionOfProjection()};
  const Eigen::Vector3d up = Eigen::Map<const Eigen::Vector3d>{camera->GetViewUp()}.normalized();
  const Eigen::Vector3d right = up.cross(towards).normalized(), above = towards.cross(right);
  const Eigen::Vector3d lo{bounds[0], bounds[2], bounds[4]}, hi{bounds[1], bounds[3], bounds[5]};
  const Eigen::Vector3d half = (hi - lo) / 2, middle = (lo + hi) / 2;
  constexpr double kMargin = 1.03;
  const int* size = r.GetVTKWindow() ? r.GetVTKWindow()->GetSize() : nullptr;
  const double aspect = size && size[0] > 0 && size[1] > 0 ? double(size[0]) / size[1] : 1.0;
  const double half_height_m = kMargin * std::max(half.dot(above.cwiseAbs()), half.dot(right.cwiseAbs()) / aspect);
  const Eigen::Vector3d eye = middle + 4 * towards;
  camera->SetFocalPoint(middle.data());
  camera->SetPosition(eye.data());
  camera->SetParallelScale(half_height_m);
  r.ResetCameraClippingRange();
}

void ModelScene::lookAt(StandardView view, const Eigen::Vector3d& p_W, double half_height_m) {
  vtkRenderer& r = parts_->renderer;
  const Eigen::Matrix3d R_WC = viewAxes(view);
  const Eigen::Vector3d eye = p_W + 4 * R_WC.col(2), above = R_WC.col(1);  // m: outside of every body
  vtkCamera* camera = r.GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(p_W.data());
  camera->SetPosition(eye.data());
  camera->SetViewUp(above.data());
  camera->SetParallelScale(half_height_m);
  r.ResetCameraClippingRange();
}

RgbImage renderModel(const Model& model, const Posture& posture, const ModelPicture& picture) {
  const auto compose = [&](vtkRenderer& renderer) {
    ModelScene scene{renderer};
    scene.setModel(std::make_shared<const Model>(model));
    scene.setPosture(posture);
    scene.setBackdrop(picture.backdrop);
    if (picture.scalars) scene.colourMusclesBy(*picture.scalars);
    scene.setVisible(SceneLayer::Muscles, picture.muscles);
    scene.setVisible(SceneLayer::MechanicalAxes, picture.mechanical_axes);
    scene.setVisible(SceneLayer::Landmarks, picture.landmarks);
    if (picture.rom) scene.setRom(picture.rom, picture.rom_widest_rad);
    if (picture.focus)
      scene.lookAt(picture.view, picture.focus->p_W, picture.focus->half_height_m);
    else
      scene.lookFrom(picture.view);
  };
  return renderOffscreen(picture.width_px, picture.height_px, compose, picture.quality);
}

}  // namespace sinew
