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

}  // namespace

struct ModelScene::Parts {
  explicit Parts(vtkRenderer& r) : renderer{r}, bones{r}, muscles{r}, axes{r}, landmarks{r} {}

  void requireModel() const { require(model != nullptr, "the scene has no model yet"); }

  void drawMuscles() {
    if (model) muscles.draw(model->musculature, shown, X_WB, [this](int unit) { return colourOf(unit); });
  }
  Rgb colourOf(int unit) const {
    const auto& u = model->musculature.units[unit];
    if (!selected.empty() && u.name == selected) return palette::kYellow;
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
  parts_->bones.setBones(*parts_->model->bones);
  parts_->X_WB.clear();
  setShownMuscles(std::nullopt);
  setPosture(zeroPosture(parts_->model->skeleton));
}

void ModelScene::setPosture(const Posture& q) {
  parts_->requireModel();
  const auto& skeleton = parts_->model->skeleton;
  require(q.size() == skeleton.coordinateCount(), "setPosture: another number of coordinates");
  parts_->X_WB = segmentPoses(skeleton, q);
  parts_->bones.setPoses(parts_->X_WB);
  parts_->axes.draw(legAxes(skeleton, parts_->X_WB));
  parts_->landmarks.draw(skeleton, parts_->X_WB);
  parts_->drawMuscles();
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
  const Eigen::Vector3d centre = (lo + hi) / 2, out = viewpoint(view), up = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d right = up.cross(out).normalized(), above = out.cross(right);
  const Eigen::Vector3d half = (hi - lo) / 2;
  const double half_width = half.dot(right.cwiseAbs()), half_height = half.dot(above.cwiseAbs());

  vtkCamera* camera = r.GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(centre.data());
  const Eigen::Vector3d eye = centre + 4 * out;  // m: outside of every body
  camera->SetPosition(eye.data());
  camera->SetViewUp(above.data());
  constexpr double kMargin = 1.03;
  const int* size = r.GetVTKWindow() ? r.GetVTKWindow()->GetSize() : nullptr;
  const double aspect = size && size[0] > 0 && size[1] > 0 ? double(size[0]) / size[1] : 1.0;
  camera->SetParallelScale(kMargin * std::max(half_height, half_width / aspect));
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
    scene.lookFrom(picture.view);
  };
  return renderOffscreen(picture.width_px, picture.height_px, compose, picture.quality);
}

}  // namespace sinew
