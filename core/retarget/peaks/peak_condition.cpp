#include <algorithm>

#include "core/retarget/peaks/peak_condition_internal.h"

namespace sinew {

std::vector<TorqueCondition> peakConditions(int sample, double low, double high) {
  constexpr int kLast = TorqueGeometry::kSamples - 1;
  // Where a peak can lie whose highest sample is this one.
  const double first = std::max(0.0, sample - 0.5), last = std::min<double>(kLast, sample + 0.5);
  if (low > last || high < first) return {};
  std::vector<TorqueCondition> conditions;
  for (int s = 0; s <= kLast; ++s)
    if (s != sample) conditions.push_back({{sample, s, s}, {1, -1, 0}});
  // The parabola through three samples rises (sign 1) or falls (-1) at a place.
  constexpr double kSlope = 4;  // beside differences of heights, which a peak shifted by a sample changes less
  const int middle = std::clamp(sample, 1, kLast - 1);
  const auto addSlope = [&](double place, double sign) {
    const double t = place - middle, weight = sign * kSlope;
    conditions.push_back(
        {{middle - 1, middle, middle + 1}, {weight * (t - 0.5), weight * -2 * t, weight * (t + 0.5)}});
  };
  if (low > first) addSlope(low, 1);
  if (high < last) addSlope(high, -1);
  return conditions;
}

std::vector<std::vector<TorqueCondition>> peakAlternatives(double low, double high) {
  std::vector<std::vector<TorqueCondition>> alternatives;
  for (int s = 0; s < TorqueGeometry::kSamples; ++s)
    if (auto conditions = peakConditions(s, low, high); !conditions.empty())
      alternatives.push_back(std::move(conditions));
  return alternatives;
}

std::vector<std::vector<TorqueCondition>> peakAlternatives(double wanted_theta, double tolerance_deg,
                                                           double span_deg) {
  constexpr int kSteps = TorqueGeometry::kSamples - 1;
  const double wanted = wanted_theta * kSteps, tolerance = tolerance_deg * kSteps / span_deg;
  return peakAlternatives(wanted - tolerance, wanted + tolerance);
}

}  // namespace sinew
