#include "core/retarget/retarget.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "core/model/physical_scaling.h"
#include "core/posture/muscle_role.h"
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

/// Seconds since it was last asked.
class StopWatch {
 public:
  double lap_s() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// One step of several: its share of the progress.
Job step(const Job& job, double from, double to) {
  if (!job.report_to) return job;
  return {[report = job.report_to, from, to](double fraction, std::string_view stage) {
            report(from + (to - from) * fraction, stage);
          },
          job.stop};
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
                                               loadRomNorms(resource_dir, model.skeleton).tests));
  auto motions = loadJointMotions(resource_dir, model.skeleton);
  return std::make_shared<const RetargetReference>(std::move(model), std::move(motions), std::move(poses));
}

namespace {

/// Whether units may be taken over.
bool serves(const Retargeted* previous, const RetargetOptions& options) {
  return previous && previous->outcome == Outcome::Converged && previous->torque_geometry &&
         previous->options.method == options.method && previous->options.weights == options.weights;
}

Retargeted retargeted(const RetargetReference& reference, const ShapeParameters& shape,
                      const RetargetOptions& options, const Job& job, const Retargeted* previous) {
  StopWatch watch;
  Retargeted result{.model = deformedModel(reference.model(), shape)};
  if (options.physics) result.model = withPhysics(result.model, reference.model(), *options.physics);
  result.times.deformation_s = watch.lap_s();
  result.options = options;
  const Retargeted cancelled{.outcome = Outcome::Cancelled};
  if (job.cancelled()) return cancelled;

  if (!serves(previous, options)) previous = nullptr;
  std::vector<bool> unchanged;
  std::optional<PreviousRouting> previous_routing;
  if (previous) {
    unchanged = unchangedUnits(reference.routing(), previous->model.shape, shape);
    previous_routing.emplace(previous->model, previous->routing);
  }
  Routing routing = route(reference.model(), reference.routing(), result.model, {options.method, options.weights},
                          step(job, 0, 0.6), previous_routing ? &*previous_routing : nullptr);
  if (routing.outcome == Outcome::Cancelled) return cancelled;
  result.routing = std::move(routing.units);
  result.times.routing_s = watch.lap_s();

  const bool naive = options.method == RetargetMethod::Naive;
  if (!naive) {
    std::optional<PreviousLengths> previous_lengths;
    if (previous) previous_lengths.emplace(previous->lengths, unchanged);
    result.lengths = setMaximalLengths(reference, result.model, step(job, 0.6, 0.8),
                                       previous_lengths ? &*previous_lengths : nullptr);
    if (result.lengths.outcome == Outcome::Cancelled) return cancelled;
  }
  result.times.lengths_s = watch.lap_s();

  result.torque_geometry =
      previous ? std::make_shared<const TorqueGeometry>(result.model, reference.torquePostures(),
                                                        reference.unitsOfMotion(), reference.motions(),
                                                        *previous->torque_geometry, unchanged)
               : std::make_shared<const TorqueGeometry>(result.model, reference.torquePostures(),
                                                        reference.unitsOfMotion(), reference.motions());
  PeakTorqueOptions peak_options;
  if (naive || !options.peak_torque) peak_options.most_iterations = 0;
  if (shape.sides[0] == shape.sides[1]) {
    peak_options.mirror_of = reference.routing().mirrorOf();
    peak_options.mirror_motion_of = reference.mirrorMotionOf();
  }
  const auto optimize = options.method == RetargetMethod::Paper ? descendPeakTorque : optimizePeakTorque;
  PeakTorqueResult peaks = optimize(*result.torque_geometry, reference.motions(), reference.peakThetas(),
                                    result.model.musculature, peak_options, step(job, 0.8, 1));
  if (peaks.outcome == Outcome::Cancelled) return cancelled;
  result.peak_torque = std::move(peaks.angles);
  result.fiber_tendon_ratio = std::move(peaks.ratio);
  result.times.peak_torque_s = watch.lap_s();
  result.outcome = Outcome::Converged;
  return result;
}

}  // namespace

Retargeted retarget(const RetargetReference& reference, const ShapeParameters& shape, const RetargetOptions& options,
                    const Job& job) {
  return retargeted(reference, shape, options, job, nullptr);
}

Retargeted retarget(const RetargetReference& reference, const ShapeParameters& shape, const RetargetOptions& options,
                    const Job& job, const Retargeted& previous) {
  return retargeted(reference, shape, options, job, &previous);
}

}  // namespace sinew
