#include "core/retarget/peaks/peak_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/retarget/peaks/peak_condition_internal.h"

namespace sinew {
namespace {

constexpr int kSamples = TorqueGeometry::kSamples;

/// What every unit gives at every ratio (columns), in shares of the greatest torque at first: the samples of all
/// motions one below the other.
std::vector<Eigen::MatrixXd> tabulated(const TorqueGeometry& geometry, std::span<const PeakWish> wishes,
                                       const Musculature& musculature, const PeakReachOptions& options) {
  const auto rows = static_cast<Eigen::Index>(wishes.size()) * kSamples;
  std::map<int, Eigen::MatrixXd> by_unit;
  for (std::size_t w = 0; w < wishes.size(); ++w) {
    MotionTorques::Samples first = MotionTorques::Samples::Zero();
    const auto place = static_cast<Eigen::Index>(w) * kSamples;
    for (const TorqueGeometry::UnitInMotion& swept : geometry.unitsOf(wishes[w].index)) {
      RatioForce force{musculature.units[static_cast<std::size_t>(swept.unit)]};
      std::array<CurveValue, kSamples> fiber{};
      const auto torque_Nm = [&](int s) {
        const auto i = static_cast<std::size_t>(s);
        return swept.arm_m[i] > 0 ? swept.arm_m[i] * force.at(swept.length_m[i], fiber[i]).value : 0;
      };
      for (int s = 0; s < kSamples; ++s) first[s] += torque_Nm(s);
      Eigen::MatrixXd& table =
          by_unit.try_emplace(swept.unit, Eigen::MatrixXd::Zero(rows, options.ratios)).first->second;
      for (int r = 0; r < options.ratios; ++r) {
        force.setFactor(1 + options.largest_change * (2.0 * r / (options.ratios - 1) - 1));
        for (int s = 0; s < kSamples; ++s) table(place + s, r) = torque_Nm(s);
      }
    }
    for (auto& [unit, table] : by_unit) table.middleRows(place, kSamples) /= first.maxCoeff();
  }
  std::vector<Eigen::MatrixXd> tables;
  for (auto& [unit, table] : by_unit) tables.push_back(std::move(table));
  return tables;
}

/// Every unit where the weighted sum of samples is greatest.
Eigen::VectorXd bestResponse(const std::vector<Eigen::MatrixXd>& tables, const Eigen::VectorXd& weights) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(weights.size());
  for (const Eigen::MatrixXd& table : tables) {
    Eigen::Index best = 0;
    (weights.transpose() * table).maxCoeff(&best);
    sum += table.col(best);
  }
  return sum;
}

PeakReach decide(const std::vector<Eigen::MatrixXd>& tables, const std::vector<TorqueCondition>& conditions,
                 int most_rounds) {
  const auto count = static_cast<Eigen::Index>(conditions.size());
  Eigen::ArrayXd won = Eigen::ArrayXd::Zero(count), now{count};  // by condition, over all rounds and in this one
  double largest = 1e-3;
  for (int round = 0; round < most_rounds; ++round) {
    const double rate = 4 * std::sqrt(std::log(double(count)) / (round + 1)) / largest;
    Eigen::ArrayXd weight = (rate * (won.minCoeff() - won)).exp();
    weight /= weight.sum();
    Eigen::VectorXd by_sample = Eigen::VectorXd::Zero(tables.front().rows());
    for (Eigen::Index c = 0; c < count; ++c)
      for (std::size_t i = 0; i < 3; ++i)
        by_sample[conditions[static_cast<std::size_t>(c)].sample[i]] +=
            weight[c] * conditions[static_cast<std::size_t>(c)].weight[i];
    const Eigen::VectorXd response = bestResponse(tables, by_sample);
    if (by_sample.dot(response) < 0) return PeakReach::Out;
    for (Eigen::Index c = 0; c < count; ++c) now[c] = conditions[static_cast<std::size_t>(c)].of(response);
    if (now.minCoeff() >= 0) return PeakReach::Within;
    won += now;
    largest = std::max(largest, now.abs().maxCoeff());
  }
  return PeakReach::Undecided;
}

using Conditions = std::vector<TorqueCondition>;

/// Every choice of one alternative for each wish: conditions on the samples of all.
std::vector<Conditions> combined(std::span<const PeakWish> wishes, double tolerance_deg) {
  std::vector<Conditions> all{{}};
  for (std::size_t w = 0; w < wishes.size(); ++w) {
    const double span_deg = std::abs(wishes[w].motion.end_deg - wishes[w].motion.start_deg);
    const auto alternatives = peakAlternatives(wishes[w].wanted_theta, tolerance_deg, span_deg);
    std::vector<Conditions> longer;
    for (const Conditions& chosen : all)
      for (const Conditions& more : alternatives) {
        Conditions& both = longer.emplace_back(chosen);
        for (TorqueCondition c : more) {
          for (int& sample : c.sample) sample += static_cast<int>(w) * kSamples;
          both.push_back(c);
        }
      }
    all = std::move(longer);
  }
  return all;
}

}  // namespace

PeakReach peakReach(const TorqueGeometry& geometry, std::span<const PeakWish> wishes, const Musculature& musculature,
                    const PeakReachOptions& options) {
  const auto tables = tabulated(geometry, wishes, musculature, options);
  PeakReach reach = PeakReach::Out;
  for (const Conditions& conditions : combined(wishes, options.tolerance_deg)) {
    const PeakReach one = decide(tables, conditions, options.most_rounds);
    if (one == PeakReach::Within) return one;
    if (one == PeakReach::Undecided) reach = one;
  }
  return reach;
}

}  // namespace sinew
