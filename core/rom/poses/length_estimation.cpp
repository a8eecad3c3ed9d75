#include "core/rom/poses/length_estimation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/error.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"

namespace sinew {
namespace {

using Poses = std::vector<RigidTransform>;

MusculotendonUnit scaled(MusculotendonUnit unit, double scale) {
  unit.optimal_fiber_length_m *= scale;
  unit.tendon_slack_length_m *= scale;
  return unit;
}

double passiveForceShare(const MusculotendonUnit& unit, double path_m) {
  return equilibrium(unit, path_m, 0).force_N / unit.max_isometric_force_N;
}

/// Smallest scale >= `from` at which the unit rests at this path length.
double relaxedScale(const MusculotendonUnit& unit, double path_m, double from, double allowed_share) {
  if (passiveForceShare(scaled(unit, from), path_m) <= allowed_share) return from;
  double low = from, high = from;
  while (passiveForceShare(scaled(unit, high), path_m) > allowed_share) high *= 1.5;
  while (high - low > 1e-9 * high) {
    const double middle = 0.5 * (low + high);
    (passiveForceShare(scaled(unit, middle), path_m) > allowed_share ? low : high) = middle;
  }
  return high;
}

/// Fit of one unit to its longest path and its paths at rest, ratio of tendon and fibre as given.
LengthEstimate fitted(const MusculotendonUnit& unit, double longest_path_m, std::span<const double> resting_paths_m,
                      double allowed_share) {
  LengthEstimate e{.unit = unit.name, .longest_path_m = longest_path_m};
  const double covering = longest_path_m / longestLength_m(unit);
  e.scale = covering;
  for (const double path_m : resting_paths_m) e.scale = relaxedScale(unit, path_m, e.scale, allowed_share);
  e.relaxed = e.scale > covering * (1 + 1e-6);
  const MusculotendonUnit sized = scaled(unit, e.scale);
  e.optimal_fiber_length_m = sized.optimal_fiber_length_m;
  e.tendon_slack_length_m = sized.tendon_slack_length_m;
  e.resting_normalized_fiber = equilibrium(sized, resting_paths_m.front(), 0).normalized_fiber_length;
  return e;
}

double fiberAt(const LengthEstimate& e, MusculotendonUnit unit, double path_m) {
  unit.optimal_fiber_length_m = e.optimal_fiber_length_m;
  unit.tendon_slack_length_m = e.tendon_slack_length_m;
  return equilibrium(unit, path_m, 0).normalized_fiber_length;
}

/// The last ratio on the way from `from`, where `holds` is true, to `to` at which it still is.
double lastRatio(double from, double to, const std::function<bool(double)>& holds) {
  if (holds(to)) return to;
  while (std::abs(to - from) > 1e-6) {
    const double middle = 0.5 * (from + to);
    (holds(middle) ? from : to) = middle;
  }
  return from;
}

struct WorkingPath {
  double shortest_m, lengthened;
};

/// The same, but a fibre that would stand or work too short takes length from its tendon.
LengthEstimate fittedWithUsableFiber(const MusculotendonUnit& unit, double longest_path_m,
                                     std::span<const double> resting_paths_m, std::optional<WorkingPath> working,
                                     const LengthEstimationOptions& options) {
  const auto fit = [&](double ratio) {
    MusculotendonUnit changed = unit;
    changed.tendon_slack_length_m *= ratio;
    LengthEstimate e = fitted(changed, longest_path_m, resting_paths_m, options.resting_force_share);
    e.ratio = ratio;
    return e;
  };
  const auto stands = [&](double ratio) { return fit(ratio).resting_normalized_fiber >= options.shortest_fiber; };
  const double standing = lastRatio(options.smallest_ratio, 1, stands);
  if (!working) return fit(standing);

  const auto lengthened = [&](double ratio) {
    LengthEstimate e = fit(ratio);
    e.optimal_fiber_length_m *= working->lengthened;
    e.tendon_slack_length_m *= working->lengthened;
    return e;
  };
  const auto working_fiber = [&](double ratio) { return fiberAt(lengthened(ratio), unit, working->shortest_m); };
  const auto published = [&](double ratio) {
    return lengthened(ratio).optimal_fiber_length_m <=
           options.longest_fiber_of_published * unit.optimal_fiber_length_m;
  };
  // At most as much tendon as leaves a fibre like published ones. A unit that this does not cure keeps its ratio:
  // half a cure would change it for nothing.
  if (!published(1)) return fit(standing);
  const double least = lastRatio(1, options.smallest_ratio, published);
  if (working_fiber(least) < options.least_working_fiber) return fit(standing);
  const auto works = [&](double ratio) { return working_fiber(ratio) >= options.shortest_fiber; };
  return fit(std::min(standing, lastRatio(least, 1, works)));
}

}  // namespace

std::vector<LengthEstimate> estimateLengths(const Skeleton& skeleton, const Musculature& musculature,
                                            const PathLimits& limits, std::span<const Posture> resting,
                                            const LengthEstimationOptions& options, const WorkingPaths& working) {
  const auto count = static_cast<Eigen::Index>(musculature.units.size());
  require(working.shortest_m.size() == 0 || working.shortest_m.size() == count,
          "estimateLengths: one working path a unit");
  require(working.lengthened.size() == 0 || working.lengthened.size() == count, "estimateLengths: one factor a unit");
  require(!resting.empty(), "estimateLengths: resting postures are given");
  std::vector<Poses> resting_poses;
  for (const Posture& q : resting) resting_poses.push_back(segmentPoses(skeleton, q));
  std::vector<LengthEstimate> estimates;
  for (const MusculotendonUnit& unit : musculature.units) {
    std::vector<double> resting_paths_m;
    for (const Poses& X_WB : resting_poses) resting_paths_m.push_back(pathLength(unit, X_WB));
    const auto i = static_cast<Eigen::Index>(estimates.size());
    std::optional<WorkingPath> path;
    if (working.shortest_m.size() > 0)
      path = {working.shortest_m[i], working.lengthened.size() > 0 ? working.lengthened[i] : 1};
    estimates.push_back(fittedWithUsableFiber(unit, limits.longest_m[i], resting_paths_m, path, options));
    estimates.back().shortest_path_m = limits.shortest_m[i];
  }
  return estimates;
}

double relaxingFactor(const MusculotendonUnit& unit, double path_m, double share) {
  return relaxedScale(unit, path_m, 1, share);
}

Musculature withLengths(Musculature musculature, const std::vector<LengthEstimate>& estimates) {
  require(estimates.size() == musculature.units.size(), "withLengths: one estimate a unit");
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    musculature.units[i].optimal_fiber_length_m = estimates[i].optimal_fiber_length_m;
    musculature.units[i].tendon_slack_length_m = estimates[i].tendon_slack_length_m;
  }
  return musculature;
}

std::string lengthsCsv(const std::vector<LengthEstimate>& estimates, const std::string& made_from) {
  std::string csv =
      "# sinew.reference_lengths 1: right side; made by sinew-fit-lengths from muscles.csv, muscle_paths.csv, the "
      "skeleton and " +
      made_from +
      ": longest path over the pose set, fibre : tendon ratio within 30 % of the published, no pull at rest\n"
      "muscle,optimal_fiber_length_m,tendon_slack_length_m,longest_path_m,shortest_path_m,scale_of_published,"
      "tendon_share_of_published,relaxed,standing_normalized_fiber_length,shortest_normalized_fiber_length,"
      "longest_normalized_fiber_length\n";
  const auto up = [](double length_m) { return std::ceil(length_m * 1e7) * 1e-7; };
  for (const LengthEstimate& e : estimates) {
    if (!e.unit.ends_with("_r")) continue;
    csv += fmt::format("{},{:.7f},{:.7f},{:.5f},{:.5f},{:.3f},{:.3f},{},{:.3f},{:.3f},{:.3f}\n", e.unit,
                       up(e.optimal_fiber_length_m), up(e.tendon_slack_length_m), e.longest_path_m, e.shortest_path_m,
                       e.scale, e.ratio, e.relaxed ? "yes" : "no", e.resting_normalized_fiber,
                       e.shortest_normalized_fiber, e.longest_normalized_fiber);
  }
  return csv;
}

}  // namespace sinew
