#include "app/model/retarget/muscle_change.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "core/muscle/muscle_path.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/prepared/reversals.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

void findPeak(const RetargetReference& reference, const Retargeted& retargeted, MuscleChange& change) {
  double furthest_deg = -1;
  for (std::size_t m = 0; m < retargeted.peak_torque.size(); ++m) {
    if (!std::ranges::count(reference.unitsOfMotion()[m], change.unit)) continue;
    const PeakTorqueAngle& peak = retargeted.peak_torque[m];
    const double before_deg = peak.before_deg - peak.reference_deg, after_deg = peak.after_deg - peak.reference_deg;
    const double off_deg = std::max(std::abs(before_deg), std::abs(after_deg));
    if (!(off_deg > furthest_deg)) continue;
    furthest_deg = off_deg;
    change.peak_motion = peak.motion;
    change.peak_before_deg = before_deg;
    change.peak_after_deg = after_deg;
  }
}

}  // namespace

std::vector<int> reversedMotions(const RetargetReference& reference, const MotionPoses& poses,
                                 const Musculature& musculature, std::size_t unit) {
  const ReferenceCurves& curves = reference.routing().curves(unit);
  std::vector<int> reversed;
  for (std::size_t k = 0; k < curves.motions.size(); ++k) {
    const std::span before{&curves.lengths[k * kRoutingSamples], kRoutingSamples};
    std::vector<double> lengths_m;
    for (int s = 0; s < kRoutingSamples; ++s)
      lengths_m.push_back(pathLength(musculature.units[unit], poses.at(curves.motions[k], s)));
    StepCount steps;
    countReversals(stepDirections(before), lengths_m, steps);
    reversed.push_back(steps.reversed > 0 && curves.significance[k] > 0);
  }
  return reversed;
}

std::vector<MuscleChange> muscleChanges(const RetargetReference& reference, const Model& naive,
                                        const Retargeted& retargeted) {
  const RoutingWeights weights;
  const MotionPoses poses{naive.skeleton, reference.routing().motions()};
  std::vector<MuscleChange> changes(retargeted.routing.size());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    MuscleChange& c = changes[i];
    const UnitRouting& routing = retargeted.routing[i];
    const auto& before = reference.model().musculature.units[i];
    const auto& after = retargeted.model.musculature.units[i];
    const auto sum = [](const std::vector<int>& v) { return std::accumulate(v.begin(), v.end(), 0); };
    c.unit = int(i);
    c.energy_naive = routing.start.total(weights);
    c.energy = routing.end.total(weights);
    c.reversals_naive = sum(reversedMotions(reference, poses, naive.musculature, i));
    c.reversals = sum(reversedMotions(reference, poses, retargeted.model.musculature, i));
    c.motions = int(reference.routing().curves(i).motions.size());
    c.length_factor = (after.optimal_fiber_length_m + after.tendon_slack_length_m) /
                      (before.optimal_fiber_length_m + before.tendon_slack_length_m);
    c.ratio_factor = retargeted.fiber_tendon_ratio.empty() ? 1 : retargeted.fiber_tendon_ratio[i];
    c.largest_move_m = routing.largest_move_m;
    findPeak(reference, retargeted, c);
  }
  return changes;
}

}  // namespace sinew
