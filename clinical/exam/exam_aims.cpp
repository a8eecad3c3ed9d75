#include <algorithm>
#include <cmath>

#include "clinical/exam/exam_problem_internal.h"

namespace sinew {
namespace {

/// The test's groups with one factor, the others unchanged.
LengthFactors alone(const MeasuredTest& test, const std::vector<FreeGroup>& groups, double factor) {
  std::vector<double> factors(groups.size(), 1.0);
  for (const int g : test.groups) factors[std::size_t(g)] = factor;
  return lengthFactors(groups, factors, Scaled::FiberAndTendon);
}

/// Common factor of the test's groups at which this test by itself is met; at a bound if none does.
double factorAlone(const MeasuredTest& test, const std::vector<FreeGroup>& groups, double measured_place) {
  const auto excess = [&](double factor) {
    return test.sweep->excess(measured_place, test.threshold_Nm, alone(test, groups, factor));
  };
  double low = kLeastFactor, high = kMostFactor;  // longer muscles hold less
  if (excess(low) < 0) return low;
  if (excess(high) > 0) return high;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The factor that is asked for at `test.measured_place`, rising from the edge of the norm by no more than
/// kSteepest_per_deg anywhere on the way: the nearest such curve on the side of 1. `sign`: -1 towards tighter places.
double fadedFactor(const MeasuredTest& test, const std::vector<FreeGroup>& groups, double edge, double asked,
                   double sign) {
  constexpr double kStep_deg = 1;
  double factor = std::abs(asked - 1);
  if (sign * (asked - 1) <= 0) return 1;  // never longer for a tighter body, never shorter for a laxer one
  const double away_deg = std::abs(test.measured_place - edge);
  const double along = test.measured_place > edge ? 1 : -1;
  for (double back_deg = kStep_deg; back_deg < away_deg; back_deg += kStep_deg) {
    const double there = sign * (factorAlone(test, groups, test.measured_place - along * back_deg) - 1);
    factor = std::min(factor, std::max(0.0, there) + kSteepest_per_deg * back_deg);
  }
  factor = std::min(factor, kSteepest_per_deg * away_deg);
  return 1 + sign * factor;
}

/// SD of a place so that what it says of the factor is never less than kSteepest_per_deg times the measurement's.
/// Beside a stiff capsule the place hardly depends on lengths; the pull to 1 would win there, and then suddenly not.
double sdOfPlace_deg(const MeasuredTest& test, const std::vector<FreeGroup>& groups, double factor) {
  constexpr double kFactor = 0.01, kLeastShare = 0.01;
  const auto place = [&](double f) { return test.sweep->freeEnd_deg(test.threshold_Nm, alone(test, groups, f)); };
  const double per_factor_deg = std::abs(place(factor + kFactor) - place(factor - kFactor)) / (2 * kFactor);
  return test.test->form->measurement_sd_deg * std::clamp(per_factor_deg * kSteepest_per_deg, kLeastShare, 1.0);
}

/// The norm as an interval of places along the movement.
std::pair<double, double> band(const MeasuredTest& test, double own_place, bool leave_in_norm) {
  if (!leave_in_norm) return {own_place, own_place};
  const double sd_deg = test.test->form->measurement_sd_deg;
  if (!std::isfinite(test.norm.mean_deg)) return {own_place - sd_deg, own_place + sd_deg};
  const double mean = test.sweep->placeOf_deg(test.norm.mean_deg);
  const double half = std::isfinite(test.norm.sd_deg) ? std::max(sd_deg, test.norm.sd_deg) : sd_deg;
  return {mean - half, mean + half};
}

}  // namespace

LengthFactors lengthFactors(const std::vector<FreeGroup>& groups, const std::vector<double>& factors, Scaled scaled) {
  LengthFactors by_unit;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const int unit : groups[g].units)
      by_unit[unit] = {factors[g], scaled == Scaled::FiberAndTendon ? factors[g] : 1.0};
  return by_unit;
}

ExamAim aimOf(const MeasuredTest& test, const std::vector<FreeGroup>& groups, bool leave_in_norm) {
  const double direction = test.sweep->direction();
  const double free_place = test.sweep->freeEnd_deg(test.threshold_Nm);
  ExamAim aim{.place = free_place, .own_place = free_place, .sd_deg = test.test->form->measurement_sd_deg};
  if ((free_place - test.sweep->end_deg()) * direction > 0) aim.own_place = test.sweep->end_deg();
  const auto [low, high] = band(test, aim.own_place, leave_in_norm);
  // Along the movement, so that less is always tighter.
  const double tight = direction > 0 ? low : -high, lax = direction > 0 ? high : -low;
  const double measured = direction * test.measured_place;
  aim.unattainable = measured > direction * aim.own_place;
  if (measured >= tight && measured <= lax) {
    aim.in_norm = leave_in_norm;
    return aim;
  }
  const double asked = aim.asked = factorAlone(test, groups, test.measured_place);
  aim.unattainable = aim.unattainable && asked >= kMostFactor;
  // A body tighter than the norm is never made longer for it, a laxer one never shorter: the factor is monotone in
  // the measurement, also where the norm of the age is not what this body has by itself.
  const double factor = measured < tight ? fadedFactor(test, groups, direction * tight, asked, -1)
                                         : fadedFactor(test, groups, direction * lax, asked, 1);
  if (factor == asked && asked > kLeastFactor && asked < kMostFactor) {
    aim.place = test.measured_place;
    aim.sd_deg = sdOfPlace_deg(test, groups, asked);
    return aim;
  }
  aim.faded = true;
  aim.faded_to = factor;
  aim.place = test.sweep->freeEnd_deg(test.threshold_Nm, alone(test, groups, factor));
  return aim;
}

}  // namespace sinew
