#include "core/retarget/prepared/reference.h"

#include <algorithm>
#include <utility>

#include "core/posture/muscle_role.h"
#include "core/rom/poses/longest_paths.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

/// By motion: the units that span its coordinate.
std::vector<std::vector<int>> unitsSpanning(const Model& model, const std::vector<JointMotion>& motions) {
  const Kinematics clinical = clinicalKinematics(model.skeleton, zeroPosture(model.skeleton));
  std::vector<std::vector<int>> units(motions.size());
  for (std::size_t u = 0; u < model.musculature.units.size(); ++u) {
    const std::vector<int> spanned = spannedCoordinates(model.musculature.units[u], clinical);
    for (std::size_t m = 0; m < motions.size(); ++m)
      if (std::ranges::count(spanned, model.skeleton.coordinateIndex(motions[m].coordinate)))
        units[m].push_back(static_cast<int>(u));
  }
  return units;
}

std::vector<double> peaksOf(const Musculature& musculature, const TorqueGeometry& geometry) {
  std::vector<double> thetas;
  for (std::size_t m = 0; m < geometry.motionCount(); ++m)
    thetas.push_back(peakTheta(motionTorque_Nm(musculature, geometry, m)));
  return thetas;
}

}  // namespace

RetargetReference::RetargetReference(Model model, std::vector<JointMotion> motions,
                                     std::shared_ptr<const PoseSet> poses)
    : model_{std::move(model)},
      motions_{std::move(motions)},
      poses_{std::move(poses)},
      routing_{model_, motions_},
      longest_m_{longestOverPoses(model_.skeleton, model_.musculature, *poses_)},
      ranges_{model_},
      torque_postures_{motionPostures(model_.skeleton, motions_)},
      units_of_motion_{unitsSpanning(model_, motions_)},
      mirror_motion_of_{mirrorMotions(model_.skeleton, motions_)},
      peak_thetas_{peaksOf(model_.musculature, {model_, torque_postures_, units_of_motion_, motions_})} {}

std::shared_ptr<const RetargetReference> loadRetargetReference(const std::filesystem::path& resource_dir,
                                                               std::string_view preset) {
  Model model = loadReferenceModel(resource_dir, preset);
  auto poses =
      std::make_shared<PoseSet>(sampledPoseSet(model.skeleton, loadRomPreset(resource_dir, preset, model.skeleton),
                                               loadClinicalTests(resource_dir, model.skeleton).tests));
  auto motions = loadJointMotions(resource_dir, model.skeleton);
  return std::make_shared<const RetargetReference>(std::move(model), std::move(motions), std::move(poses));
}

}  // namespace sinew
