#include "core/retarget/lengths/maximal_lengths.h"

#include <algorithm>

#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/retarget/prepared/reference.h"
#include "core/rom/poses/length_estimation.h"
#include "core/rom/poses/longest_paths.h"
#include "core/rom/poses/pose_sampler.h"

namespace sinew {
namespace {

constexpr double kRestingShare = LengthEstimationOptions{}.resting_force_share;

using Poses = std::vector<RigidTransform>;

MusculotendonUnit scaled(MusculotendonUnit unit, double factor) {
  unit.optimal_fiber_length_m *= factor;
  unit.tendon_slack_length_m *= factor;
  return unit;
}

/// Poses of the segments in the postures in which nothing may pull.
std::vector<Poses> restingPoses(const Skeleton& skeleton) {
  std::vector<Poses> rest;
  for (const Posture& q : restingPostures(skeleton)) rest.push_back(segmentPoses(skeleton, q));
  return rest;
}

/// Smallest factor >= 1 with which a unit pulls at rest no more than allowed, or than the reference does if that is
/// more.
double relaxing(const MusculotendonUnit& before, const std::vector<Poses>& reference_rest,
                const MusculotendonUnit& unit, const std::vector<Poses>& rest) {
  double factor = 1;
  for (std::size_t r = 0; r < rest.size(); ++r) {
    const double pulled_before =
        equilibrium(before, pathLength(before, reference_rest[r]), 0).force_N / before.max_isometric_force_N;
    factor *= relaxingFactor(scaled(unit, factor), pathLength(unit, rest[r]), std::max(kRestingShare, pulled_before));
  }
  return factor > 1 + 1e-9 ? factor : 1;
}

/// Fills in longest paths that are still 0; false if cancelled.
bool sweepUnknown(const Model& model, const PoseSet& poses, std::vector<double>& longest_m, const Job& job) {
  Musculature unknown;
  for (std::size_t u = 0; u < longest_m.size(); ++u)
    if (longest_m[u] == 0) unknown.units.push_back(model.musculature.units[u]);
  if (unknown.units.empty()) return !job.cancelled();
  const std::vector<double> found_m = longestOverPoses(model.skeleton, unknown, poses, job);
  if (found_m.empty()) return false;
  auto next = found_m.begin();
  for (double& length_m : longest_m)
    if (length_m == 0) length_m = *next++;
  return true;
}

/// What nothing has changed about, by joint.
std::vector<std::shared_ptr<const RangeLengths>> knownLengths(const RetargetReference& reference,
                                                              const PreviousLengths* previous) {
  if (!previous) return {};
  auto known = previous->lengths.range_lengths;
  for (std::size_t j = 0; j < known.size(); ++j)
    if (!std::ranges::all_of(reference.ranges().joints()[j].units,
                             [&](int u) { return previous->unchanged[std::size_t(u)]; }))
      known[j].reset();
  return known;
}

/// Of a body that is its own mirror image: its muscles are too, though the fit goes from one to the next.
void mirrorLeft(const std::vector<int>& mirror_of, const LongestLengths& bounds, std::vector<double>& longest_m) {
  for (std::size_t u = 0; u < longest_m.size(); ++u)
    if (const int left = mirror_of[u]; left > static_cast<int>(u))
      longest_m[std::size_t(left)] = std::max(longest_m[u], bounds.least_m[std::size_t(left)]);
}

/// Where the fit begins and what it keeps: the reference's share of the longest path, lengthened where that would
/// pull at rest. Sets fibre and tendon to that.
LongestLengths boundsOf(const RetargetReference& reference, Model& model, MaximalLengths& result) {
  const auto reference_rest = restingPoses(reference.model().skeleton), rest = restingPoses(model.skeleton);
  LongestLengths bounds{.least_m = result.longest_path_m};
  for (std::size_t u = 0; u < bounds.least_m.size(); ++u) {
    const MusculotendonUnit& before = reference.model().musculature.units[u];
    MusculotendonUnit& unit = model.musculature.units[u];
    const double ratio = result.longest_path_m[u] / reference.longest_m()[u];
    unit.optimal_fiber_length_m = before.optimal_fiber_length_m * ratio;
    unit.tendon_slack_length_m = before.tendon_slack_length_m * ratio;
    if (const double factor = relaxing(before, reference_rest, unit, rest); factor > 1) {
      unit = scaled(unit, factor);
      bounds.least_m[u] = std::max(bounds.least_m[u], longestLength_m(unit));
      ++result.relaxed;
    }
    bounds.start_m.push_back(longestLength_m(unit));
  }
  return bounds;
}

}  // namespace

MaximalLengths setMaximalLengths(const RetargetReference& reference, Model& model, const Job& job,
                                 const PreviousLengths* previous) {
  const auto& units_before = reference.model().musculature.units;
  MaximalLengths result{.longest_path_m = std::vector<double>(units_before.size(), 0.0)};
  for (std::size_t u = 0; previous && u < units_before.size(); ++u)
    if (previous->unchanged[u]) result.longest_path_m[u] = previous->lengths.longest_path_m[u];
  if (!sweepUnknown(model, reference.poses(), result.longest_path_m, job)) return {.outcome = Outcome::Cancelled};
  Model fitted = model;
  const LongestLengths bounds = boundsOf(reference, fitted, result);
  RangeFit fit = fitToRanges(reference.ranges(), fitted, bounds, knownLengths(reference, previous), job);
  if (fit.outcome != Outcome::Converged) return {.outcome = Outcome::Cancelled};
  if (model.shape.sides[0] == model.shape.sides[1]) mirrorLeft(reference.routing().mirrorOf(), bounds, fit.longest_m);
  result.range_lengths = std::move(fit.lengths);
  for (std::size_t u = 0; u < units_before.size(); ++u) {
    const MusculotendonUnit& unit = fitted.musculature.units[u];
    model.musculature.units[u] = scaled(unit, fit.longest_m[u] / bounds.start_m[u]);
    result.factor.push_back(model.musculature.units[u].optimal_fiber_length_m /
                            units_before[u].optimal_fiber_length_m);
  }
  result.outcome = Outcome::Converged;
  return result;
}

}  // namespace sinew
