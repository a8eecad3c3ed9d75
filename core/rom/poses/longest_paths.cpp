#include "core/rom/poses/longest_paths.h"

#include <limits>

#include "core/kernel/batch.h"

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

}  // namespace sinew
