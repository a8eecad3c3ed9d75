#include "core/rom/poses/longest_paths.h"

#include <algorithm>
#include <limits>

#include "core/kernel/batch.h"
#include "core/kernel/sweep.h"
#include "core/parallel.h"

namespace sinew {

PathLimits longestPaths(const Skeleton& skeleton, const Musculature& musculature, const PoseStream& poses) {
  const CompiledModel model{skeleton, musculature};
  const auto count = static_cast<Eigen::Index>(musculature.units.size());
  PathLimits limits{Eigen::VectorXd::Zero(count),
                    Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity())};
  PoseTable lengths_m;
  poses([&](const Eigen::MatrixXd& postures) {
    PoseTable table{static_cast<std::size_t>(postures.cols()), static_cast<std::size_t>(postures.rows())};
    for (Eigen::Index p = 0; p < postures.cols(); ++p) table.set(static_cast<std::size_t>(p), postures.col(p));
    batchLengths(model, table, lengths_m);
    for (std::size_t p = 0; p < table.poseCount(); ++p) {
      const Eigen::VectorXd length_m = lengths_m.pose(p);
      limits.longest_m = limits.longest_m.cwiseMax(length_m);
      limits.shortest_m = limits.shortest_m.cwiseMin(length_m);
    }
  });
  return limits;
}

std::vector<double> longestOverPoses(const Skeleton& skeleton, const Musculature& musculature, const PoseSet& poses,
                                     const Job& job) {
  const CompiledModel model{skeleton, musculature};
  constexpr std::size_t kPart = 1152 * PoseTable::kBlock;  // few: each asks the longest of every unit again in double
  const std::size_t parts = (poses.size() + kPart - 1) / kPart;
  std::vector<PostureSweep> sweeps(parts);
  const bool done = forEachInParallel(parts, job, "longest paths", [&](std::size_t part) {
    const std::size_t offset = part * kPart;
    const auto read = [&](std::size_t first, PoseTable& table) { poses.read(offset + first, table); };
    sweeps[part] = sweepPostures(model, std::min(kPart, poses.size() - offset), read, Precision::Single);
  });
  if (!done) return {};
  std::vector<double> longest_m(musculature.units.size(), 0.0);
  for (const PostureSweep& sweep : sweeps)
    for (std::size_t u = 0; u < longest_m.size(); ++u) longest_m[u] = std::max(longest_m[u], sweep.longest_m[u]);
  return longest_m;
}

}  // namespace sinew
