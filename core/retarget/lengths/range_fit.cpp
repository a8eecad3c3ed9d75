#include "core/retarget/lengths/range_fit.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/rom/edit/threshold_fit_internal.h"

namespace sinew {
namespace {

constexpr double kShorter = 0.93, kLonger = 1.07;  // of the length that the fit begins from

/// What a unit of the joint may have as its longest length: more than `low` and at most `high`.
struct Interval {
  double low_m, high_m;
};

RangeLengths measured(const RangeSamples& samples, const JointRangeSamples& joint, const Model& body,
                      const LongestLengths& bounds) {
  std::vector<Interval> intervals;
  for (const int u : joint.units) {
    const double start_m = bounds.start_m[std::size_t(u)];
    intervals.push_back({std::max(bounds.least_m[std::size_t(u)], kShorter * start_m), kLonger * start_m});
  }
  RangeLengths result;
  result.of_units.resize(intervals.size());
  samples.measure(joint, body, [&](std::size_t first, std::size_t count, const PoseTable& lengths_m) {
    for (std::size_t i = 0; i < count; ++i) {
      bool forbidden = false, open = false;  // by every length that may be chosen; by some
      for (std::size_t u = 0; u < intervals.size(); ++u) {
        forbidden = forbidden || lengths_m(i, u) > intervals[u].high_m;
        open = open || lengths_m(i, u) > intervals[u].low_m;
      }
      if (forbidden || !open) continue;
      for (std::size_t u = 0; u < intervals.size(); ++u)
        if (lengths_m(i, u) > intervals[u].low_m)
          result.of_units[u].push_back({lengths_m(i, u), static_cast<std::uint32_t>(result.postures.size())});
      result.postures.push_back(static_cast<std::uint32_t>(first + i));
    }
  });
  return result;
}

/// All joints side by side: a unit that spans several has the postures of all of them.
struct JoinedRanges {
  std::vector<int> units;
  std::vector<ThresholdColumn> columns;
  ThresholdProblem problem;
};

JoinedRanges joined(const RangeSamples& samples, const std::vector<std::shared_ptr<const RangeLengths>>& lengths,
                    std::size_t unit_count) {
  JoinedRanges ranges;
  std::vector<std::vector<RangeLengths::Length>> by_unit(unit_count);
  for (std::size_t j = 0; j < lengths.size(); ++j) {
    const JointRangeSamples& joint = samples.joints()[j];
    const auto first = static_cast<std::uint32_t>(ranges.problem.wanted.size());
    for (const std::uint32_t posture : lengths[j]->postures) {
      ranges.problem.wanted.push_back(joint.samples[posture].valid);
      ranges.problem.weight.push_back(joint.samples[posture].weight);
    }
    for (std::size_t u = 0; u < joint.units.size(); ++u)
      for (const auto& length : lengths[j]->of_units[u])
        by_unit[std::size_t(joint.units[u])].push_back({length.length_m, first + length.posture});
  }
  for (std::size_t u = 0; u < unit_count; ++u) {
    if (by_unit[u].empty()) continue;
    std::ranges::stable_sort(by_unit[u], {}, &RangeLengths::Length::length_m);
    ThresholdColumn& column = ranges.columns.emplace_back();
    for (const auto& length : by_unit[u]) {
      column.value.push_back(length.length_m);
      column.sample.push_back(length.posture);
    }
    ranges.units.push_back(static_cast<int>(u));
  }
  for (const ThresholdColumn& column : ranges.columns) ranges.problem.columns.push_back(&column);
  return ranges;
}

}  // namespace

RangeFit fitToRanges(const RangeSamples& samples, const Model& body, const LongestLengths& bounds,
                     std::vector<std::shared_ptr<const RangeLengths>> known, const Job& job) {
  known.resize(samples.joints().size());
  const bool done = forEachInParallel(known.size(), job, "ranges of motion", [&](std::size_t j) {
    if (!known[j])
      known[j] = std::make_shared<const RangeLengths>(measured(samples, samples.joints()[j], body, bounds));
  });
  RangeFit result{.outcome = Outcome::Cancelled, .longest_m = bounds.start_m, .lengths = std::move(known)};
  if (!done) return result;
  const JoinedRanges ranges = joined(samples, result.lengths, bounds.start_m.size());
  std::vector<double> start_m;
  for (const int u : ranges.units) start_m.push_back(bounds.start_m[std::size_t(u)]);
  const ThresholdFit fit = descendThresholds(ranges.problem, start_m, job);
  if (fit.outcome != Outcome::Converged) return result;
  for (std::size_t i = 0; i < ranges.units.size(); ++i) {
    const auto u = std::size_t(ranges.units[i]);
    result.longest_m[u] = std::clamp(fit.threshold[i], std::max(bounds.least_m[u], kShorter * bounds.start_m[u]),
                                     kLonger * bounds.start_m[u]);
  }
  result.outcome = Outcome::Converged;
  return result;
}

}  // namespace sinew
