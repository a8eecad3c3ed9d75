#include "core/retarget/peak_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/retarget/peak_condition_internal.h"

namespace sinew {
namespace {

using Samples = MotionTorques::Samples;

/// What every unit of a motion gives at every ratio, in shares of the greatest torque at first.
std::vector<std::vector<Samples>> tabulated(const TorqueGeometry& geometry, std::size_t index,
                                            const Musculature& musculature, const PeakReachOptions& options) {
  std::vector<std::vector<Samples>> table;
  Samples first = Samples::Zero();
  for (const TorqueGeometry::UnitInMotion& swept : geometry.unitsOf(index)) {
    RatioForce force{musculature.units[static_cast<std::size_t>(swept.unit)]};
    Samples fiber = Samples::Zero();
    const auto at = [&](double ratio) {
      force.setFactor(ratio);
      Samples torque = Samples::Zero();
      for (int s = 0; s < TorqueGeometry::kSamples; ++s)
        if (const auto i = static_cast<std::size_t>(s); swept.arm_m[i] > 0)
          torque[s] = swept.arm_m[i] * force.at(swept.length_m[i], fiber[s]).value;
      return torque;
    };
    first += at(1);
    auto& row = table.emplace_back();
    for (int r = 0; r < options.ratios; ++r)
      row.push_back(at(1 + options.largest_change * (2.0 * r / (options.ratios - 1) - 1)));
  }
  const double scale_Nm = first.maxCoeff();
  for (auto& row : table)
    for (Samples& torque : row) torque /= scale_Nm;
  return table;
}

/// Every unit where the weighted sum of samples is greatest.
Samples bestResponse(const std::vector<std::vector<Samples>>& table, const Samples& weights) {
  Samples sum = Samples::Zero();
  for (const auto& row : table)
    sum += *std::ranges::max_element(row, {}, [&](const Samples& torque) { return weights.dot(torque); });
  return sum;
}

PeakReach decide(const std::vector<std::vector<Samples>>& table, const std::vector<TorqueCondition>& conditions,
                 int most_rounds) {
  const auto count = static_cast<Eigen::Index>(conditions.size());
  Eigen::ArrayXd won = Eigen::ArrayXd::Zero(count), now{count};  // by condition, over all rounds and in this one
  double largest = 1e-3;
  for (int round = 0; round < most_rounds; ++round) {
    const double rate = 4 * std::sqrt(std::log(double(count)) / (round + 1)) / largest;
    Eigen::ArrayXd weight = (rate * (won.minCoeff() - won)).exp();
    weight /= weight.sum();
    Samples by_sample = Samples::Zero();
    for (Eigen::Index c = 0; c < count; ++c)
      for (std::size_t i = 0; i < 3; ++i)
        by_sample[conditions[static_cast<std::size_t>(c)].sample[i]] +=
            weight[c] * conditions[static_cast<std::size_t>(c)].weight[i];
    const Samples response = bestResponse(table, by_sample);
    if (by_sample.dot(response) < 0) return PeakReach::Out;
    for (Eigen::Index c = 0; c < count; ++c) now[c] = conditions[static_cast<std::size_t>(c)].of(response);
    if (now.minCoeff() >= 0) return PeakReach::Within;
    won += now;
    largest = std::max(largest, now.abs().maxCoeff());
  }
  return PeakReach::Undecided;
}

}  // namespace

PeakReach peakReach(const TorqueGeometry& geometry, std::size_t index, const JointMotion& motion, double wanted_theta,
                    const Musculature& musculature, const PeakReachOptions& options) {
  constexpr int kSteps = TorqueGeometry::kSamples - 1;
  const double tolerance = options.tolerance_deg * kSteps / std::abs(motion.end_deg - motion.start_deg);
  const auto table = tabulated(geometry, index, musculature, options);
  PeakReach reach = PeakReach::Out;
  for (const auto& conditions :
       peakAlternatives(wanted_theta * kSteps - tolerance, wanted_theta * kSteps + tolerance)) {
    const PeakReach one = decide(table, conditions, options.most_rounds);
    if (one == PeakReach::Within) return one;
    if (one == PeakReach::Undecided) reach = one;
  }
  return reach;
}

}  // namespace sinew
