#include "core/retarget/retarget.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "core/model/physical_scaling.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/prepared/shape_dependencies.h"

namespace sinew {
namespace {

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
