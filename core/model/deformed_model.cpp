#include "core/error.h"
#include "core/model/deformed_bones_internal.h"
#include "core/model/model.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/shape/bone_field.h"

namespace sinew {

std::shared_ptr<const std::vector<BoneMesh>> deformedBones(const Model& reference, const ShapeParameters& shape,
                                                           const Skeleton& skeleton) {
  if (shape == reference.shape) return reference.bones;
  const std::vector<double> parameters = toVector(shape);
  auto bones = std::make_shared<std::vector<BoneMesh>>(*reference.bones);
  for (BoneMesh& bone : *bones) {
    for (Eigen::Vector3d& p : bone.mesh.vertices) p = deform(reference.skeleton, parameters, bone.segment, p);
    bone.segment = skeleton.segmentIndex(reference.skeleton.segments[bone.segment].name);
  }
  return bones;
}

Model deformedModel(const Model& reference, const ShapeParameters& shape) {
  require(reference.shape == ShapeParameters{}, "deformedModel: shapes are relative to the undeformed reference");
  Model model = reference;
  model.name = "individual";
  model.shape = shape;
  model.skeleton = deformedSkeleton(reference.skeleton, shape);
  model.passive_moments = scaledStructures(reference.passive_moments, reference.skeleton, model.skeleton);
  model.bones = deformedBones(reference, shape, model.skeleton);

  const std::vector<double> parameters = toVector(shape);
  const auto X_WB_reference = segmentPoses(reference.skeleton, zeroPosture(reference.skeleton));
  const auto X_WB = segmentPoses(model.skeleton, zeroPosture(model.skeleton));
  for (MusculotendonUnit& unit : model.musculature.units) {
    const double reference_length_m = pathLength(unit, X_WB_reference);
    for (PathPoint& point : unit.path)
      for (Anchor& anchor : point.anchors)
        anchor.p_B = deform(reference.skeleton, parameters, anchor.segment, anchor.p_B);
    const double ratio = pathLength(unit, X_WB) / reference_length_m;
    unit.optimal_fiber_length_m *= ratio;
    unit.tendon_slack_length_m *= ratio;
  }
  return model;
}

}  // namespace sinew
