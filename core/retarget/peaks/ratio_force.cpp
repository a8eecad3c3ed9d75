#include <algorithm>
#include <cmath>
#include <utility>

#include "core/retarget/peaks/ratio_force_internal.h"

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

RatioForce::RatioForce(const MusculotendonUnit& unit, std::shared_ptr<const FiberTable> table)
    : original_{withoutPath(unit)},
      curves_{unit.curves},
      table_{std::move(table)},
      cosine_{std::cos(unit.pennation_angle_at_optimal_rad)},
      by_fiber_{longestOf(original_, 1, 0)},
      by_tendon_{longestOf(original_, 0, 1)} {
  setFactor(1);
}

RatioForce::RatioForce(const MusculotendonUnit& unit)
    : RatioForce{unit,
                 std::make_shared<const FiberTable>(unit.curves, std::cos(unit.pennation_angle_at_optimal_rad))} {}

void RatioForce::setFactor(double factor) {
  const double l0 = original_.optimal_fiber_length_m, slack = original_.tendon_slack_length_m;
  const double ratio = factor * l0 / slack, longest = by_fiber_ * ratio + by_tendon_;
  slack_m_ = (by_fiber_ * l0 + by_tendon_ * slack) / longest;
  slack_slope_ = -by_fiber_ * ratio / (longest * factor);
  fiber_ = ratio * cosine_;
  fiber_slope_ = fiber_ / factor;
  shortest_ = kShortestFiber * fiber_ + table_->at(kShortestFiber).tendon.value;
}

CurveValue RatioForce::at(double length_m, CurveValue& fiber) const {
  const double length = length_m / slack_m_, length_slope = -length * slack_slope_;
  const double force_N = original_.max_isometric_force_N;
  if (length <= shortest_) {  // the fibre cannot follow any more: what the tendon carries
    fiber = {kShortestFiber, 0};
    const CurveValue tendon = curves_.tendon(length - kShortestFiber * fiber_);
    return {force_N * tendon.value, force_N * tendon.slope * (length_slope - kShortestFiber * fiber_slope_)};
  }
  constexpr double kSmall = 1e-4;  // a step behind which Newton's error is 1e-8, and the curves are straight
  double l = fiber.value > 0 ? fiber.value : (length - 1) / fiber_;
  for (int i = 0; i < 8; ++i) {
    l = std::clamp(l, FiberTable::kFirst, FiberTable::kLast);
    const FiberTable::Entry entry = table_->at(l);
    const double slope = fiber_ + entry.tendon.slope;
    if (!(slope > 0)) break;
    const double by = 1 / slope, step = (fiber_ * l + entry.tendon.value - length) * by;
    l -= step;
    if (!(std::abs(step) < kSmall)) continue;
    // Implicit function: the balance holds while fibre and tendon change along the ratio.
    const double l_slope = (length_slope - fiber_slope_ * l) * by;
    fiber = {l, l_slope};
    return {force_N * (entry.active.value - entry.active.slope * step), force_N * entry.active.slope * l_slope};
  }
  return beyondTable(length_m, fiber);
}

CurveValue RatioForce::beyondTable(double length_m, CurveValue& fiber) const {
  MusculotendonUnit unit = original_;
  unit.tendon_slack_length_m = slack_m_;
  unit.optimal_fiber_length_m = fiber_ / cosine_ * slack_m_;
  const FiberState state = equilibrium(unit, length_m, 1);
  const double l = state.normalized_fiber_length;
  const CurveValue active = curves_.active(l), passive = curves_.passive(l);
  const CurveValue tendon = curves_.tendon(length_m / slack_m_ - l * fiber_);
  const double balance_slope = (active.slope + passive.slope) * cosine_ + tendon.slope * fiber_;
  const double length_slope = -length_m / slack_m_ * slack_slope_;
  const double l_slope = balance_slope > 0 ? tendon.slope * (length_slope - l * fiber_slope_) / balance_slope : 0;
  fiber = {l, l_slope};
  return {state.active_force_N, unit.max_isometric_force_N * cosine_ * active.slope * l_slope};
}

}  // namespace sinew
