#include "app/scene/bone_layer.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>

#include "app/scene/vtk_convert.h"

namespace sinew {
namespace {

void paint(vtkActor& actor, const Rgb& colour) {
  actor.GetProperty()->SetColor(colour.r, colour.g, colour.b);
}

vtkSmartPointer<vtkActor> boneActor(const TriangleMesh& mesh) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(toPolyData(mesh));
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  auto* look = actor->GetProperty();
  look->SetAmbient(0.08);
  look->SetDiffuse(0.92);
  look->SetSpecular(0.10);  // dry bone: a weak, wide highlight
  look->SetSpecularPower(18);
  paint(*actor, palette::kBone);
  return actor;
}

}  // namespace

void BoneLayer::setBones(std::shared_ptr<const std::vector<BoneMesh>> bones) {
  // A shape that follows a hand changes a few bones, seldom all: the others keep their surfaces.
  const bool same_names = shown_ && std::ranges::equal(*shown_, *bones, {}, &BoneMesh::bone, &BoneMesh::bone);
  if (same_names) {
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      const TriangleMesh &before = (*shown_)[i].mesh, &after = (*bones)[i].mesh;
      bones_[i].segment = (*bones)[i].segment;
      if (before.vertices == after.vertices && before.triangles == after.triangles) continue;
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputData(toPolyData(after));
      bones_[i].actor->SetMapper(mapper);
    }
    shown_ = std::move(bones);
    return;
  }
  for (const auto& bone : bones_) renderer_.RemoveActor(bone.actor);
  bones_.clear();
  for (const auto& bone : *bones) {
    bones_.push_back({bone.bone, bone.segment, boneActor(bone.mesh)});
    renderer_.AddActor(bones_.back().actor);
  }
  shown_ = std::move(bones);
  setVisible(visible_);
  setOpacity(opacity_);
  select(selected_);
}

void BoneLayer::setPoses(const std::vector<RigidTransform>& X_WB) {
  for (auto& bone : bones_) {
    require(bone.segment >= 0 && bone.segment < int(X_WB.size()), "bone without a segment");
    bone.actor->SetUserMatrix(toMatrix(X_WB[bone.segment]));
  }
}

void BoneLayer::setVisible(bool visible) {
  visible_ = visible;
  for (auto& bone : bones_) bone.actor->SetVisibility(visible);
}

void BoneLayer::setOpacity(double opacity) {
  opacity_ = opacity;
  for (auto& bone : bones_) bone.actor->GetProperty()->SetOpacity(opacity);
}

void BoneLayer::select(const std::string& name) {
  selected_ = name;
  for (auto& bone : bones_) paint(*bone.actor, bone.name == selected_ ? palette::kYellow : colour_);
}

void BoneLayer::setColour(const Rgb& colour) {
  colour_ = colour;
  select(selected_);
}

std::string BoneLayer::nameOf(const vtkProp* actor) const {
  for (const auto& bone : bones_)
    if (bone.actor == actor) return bone.name;
  return {};
}

}  // namespace sinew
