#include "core/retarget/maximal_lengths.h"

#include <algorithm>

#include "core/kernel/sweep.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/parallel.h"
#include "core/rom/length_estimation.h"
#include "core/rom/pose_sampler.h"

namespace sinew {
namespace {

/// Lengthens a unit so that it pulls at rest no more than allowed, or than the reference does if that is more.
bool relax(const MusculotendonUnit& before, const std::vector<std::vector<RigidTransform>>& reference_rest,
           const std::vector<std::vector<RigidTransform>>& rest, MusculotendonUnit& unit) {
  constexpr double kAllowedShare = LengthEstimationOptions{}.resting_force_share;
  bool relaxed = false;
  for (std::size_t r = 0; r < rest.size(); ++r) {
    const double pulled_before =
        equilibrium(before, pathLength(before, reference_rest[r]), 0).force_N / before.max_isometric_force_N;
    const double factor = relaxingFactor(unit, pathLength(unit, rest[r]), std::max(kAllowedShare, pulled_before));
    if (factor <= 1 + 1e-9) continue;
    unit.optimal_fiber_length_m *= factor;
    unit.tendon_slack_length_m *= factor;
    relaxed = true;
  }
  return relaxed;
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

}  // namespace

std::vector<double> longestOverPoses(const Skeleton& skeleton, const Musculature& musculature, const PoseSet& poses,
                                     const Job& job) {
  const CompiledModel model{skeleton, musculature};
  constexpr std::size_t kPart = 512 * PoseTable::kBlock;
  const std::size_t parts = (poses.size() + kPart - 1) / kPart;
  std::vector<PostureSweep> sweeps(parts);
  const bool done = forEachInParallel(parts, job, "longest paths", [&](std::size_t part) {
    const std::size_t offset = part * kPart;
    const auto read = [&](std::size_t first, PoseTable& table) { poses.read(offset + first, table); };
    sweeps[part] = sweepPostures(model, std::min(kPart, poses.size() - offset), read, SweepPrecision::Single);
  });
  if (!done) return {};
  std::vector<double> longest_m(musculature.units.size(), 0.0);
  for (const PostureSweep& sweep : sweeps)
    for (std::size_t u = 0; u < longest_m.size(); ++u) longest_m[u] = std::max(longest_m[u], sweep.longest_m[u]);
  return longest_m;
}

MaximalLengths setMaximalLengths(const Model& reference, const std::vector<double>& reference_longest_m,
                                 const PoseSet& poses, Model& model, const Job& job,
                                 const std::vector<double>& known_longest_m) {
  MaximalLengths result{.longest_path_m = known_longest_m};
  result.longest_path_m.resize(model.musculature.units.size(), 0.0);
  if (!sweepUnknown(model, poses, result.longest_path_m, job)) return {.outcome = Outcome::Cancelled};
  std::vector<std::vector<RigidTransform>> reference_rest, rest;
  for (const Posture& q : restingPostures(reference.skeleton)) {
    reference_rest.push_back(segmentPoses(reference.skeleton, q));
    rest.push_back(segmentPoses(model.skeleton, q));
  }
  for (std::size_t u = 0; u < model.musculature.units.size(); ++u) {
    const MusculotendonUnit& before = reference.musculature.units[u];
    MusculotendonUnit& unit = model.musculature.units[u];
    const double ratio = result.longest_path_m[u] / reference_longest_m[u];
    unit.optimal_fiber_length_m = before.optimal_fiber_length_m * ratio;
    unit.tendon_slack_length_m = before.tendon_slack_length_m * ratio;
    result.relaxed += relax(before, reference_rest, rest, unit);
    result.factor.push_back(unit.optimal_fiber_length_m / before.optimal_fiber_length_m);
  }
  result.outcome = Outcome::Converged;
  return result;
}

}  // namespace sinew
