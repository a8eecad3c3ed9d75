#include <cmath>

#include "core/retarget/ratio_force_internal.h"

namespace sinew {
namespace {

/// The longest length as a linear function of fibre and tendon: what it takes of 1 m of each.
double longestOf(MusculotendonUnit unit, double fiber_m, double tendon_m) {
  unit.optimal_fiber_length_m = fiber_m;
  unit.tendon_slack_length_m = tendon_m;
  return longestLength_m(unit);
}

}  // namespace

MusculotendonUnit withoutPath(const MusculotendonUnit& unit) {
  MusculotendonUnit bare = unit;
  bare.path.clear();
  bare.source.clear();
  return bare;
}

void setFiberTendonRatio(MusculotendonUnit& unit, double factor) {
  const double longest_m = longestLength_m(unit);
  const double ratio = factor * unit.optimal_fiber_length_m / unit.tendon_slack_length_m;
  const double scale = longest_m / longestOf(withoutPath(unit), ratio, 1);
  unit.optimal_fiber_length_m = ratio * scale;
  unit.tendon_slack_length_m = scale;
}

RatioForce::RatioForce(const MusculotendonUnit& unit)
    : original_{withoutPath(unit)},
      unit_{original_},
      curves_{unit.curves},
      cosine_{std::cos(unit.pennation_angle_at_optimal_rad)} {
  setFactor(1);
}

void RatioForce::setFactor(double factor) {
  unit_.optimal_fiber_length_m = original_.optimal_fiber_length_m;
  unit_.tendon_slack_length_m = original_.tendon_slack_length_m;
  setFiberTendonRatio(unit_, factor);
  const double by_fiber = longestOf(unit_, 1, 0), by_tendon = longestOf(unit_, 0, 1);
  const double l0 = unit_.optimal_fiber_length_m, slack = unit_.tendon_slack_length_m;
  fiber_slope_m_ = l0 * by_tendon * slack / ((by_fiber * l0 + by_tendon * slack) * factor);
  slack_slope_m_ = -by_fiber / by_tendon * fiber_slope_m_;
}

CurveValue RatioForce::at(double length_m, double& start) const {
  const double l0 = unit_.optimal_fiber_length_m, slack = unit_.tendon_slack_length_m;
  double l = start, tendon_m = 0, balance_slope = 0;
  CurveValue active, passive, tendon;
  const auto imbalance = [&] {
    tendon_m = length_m - l * l0 * cosine_;
    active = curves_.active(l);
    passive = curves_.passive(l);
    tendon = curves_.tendon(tendon_m / slack);
    balance_slope = (active.slope + passive.slope) * cosine_ + tendon.slope * l0 * cosine_ / slack;
    return (active.value + passive.value) * cosine_ - tendon.value;
  };
  constexpr double kSmall = 1e-5;  // a step behind which Newton's error is 1e-10, and the curves are straight
  bool converged = false;
  for (int i = 0; i < 6 && l > kShortestFiber && !converged; ++i) {
    const double off = imbalance();
    if (!(balance_slope > 0)) break;
    const double step = off / balance_slope;
    l -= step;
    active.value -= active.slope * step;
    converged = std::abs(step) < kSmall;
  }
  if (!converged || !(l > kShortestFiber)) {
    l = equilibrium(unit_, length_m, 1).normalized_fiber_length;
    imbalance();
  }
  start = l;
  if (!(tendon.value > 0)) return {};
  const double force_N = unit_.max_isometric_force_N;
  if (l <= kShortestFiber)  // the fibre cannot follow any more: what the tendon carries
    return {force_N * tendon.value,
            -force_N * tendon.slope * (l * cosine_ * fiber_slope_m_ + tendon_m / slack * slack_slope_m_) / slack};
  // Implicit function: the balance holds while fibre and tendon change along the ratio.
  const double balance_by_factor =
      tendon.slope * (l * cosine_ * fiber_slope_m_ / slack + tendon_m / (slack * slack) * slack_slope_m_);
  const double l_slope = balance_slope > 0 ? -balance_by_factor / balance_slope : 0;
  return {force_N * cosine_ * active.value, force_N * cosine_ * active.slope * l_slope};
}

}  // namespace sinew
