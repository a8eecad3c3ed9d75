#include "core/rom/longest_paths.h"

#include <limits>

#include "core/muscle/muscle_path.h"

namespace sinew {

PathLimits longestPaths(const Skeleton& skeleton, const Musculature& musculature, const PoseStream& poses) {
  const auto count = static_cast<Eigen::Index>(musculature.units.size());
  PathLimits limits{Eigen::VectorXd::Zero(count),
                    Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity())};
  poses([&](const Eigen::MatrixXd& postures) {
    for (Eigen::Index p = 0; p < postures.cols(); ++p) {
      const auto X_WB = segmentPoses(skeleton, postures.col(p));
      for (Eigen::Index i = 0; i < count; ++i) {
        const double length_m = pathLength(musculature.units[static_cast<std::size_t>(i)], X_WB);
        limits.longest_m[i] = std::max(limits.longest_m[i], length_m);
        limits.shortest_m[i] = std::min(limits.shortest_m[i], length_m);
      }
    }
  });
  return limits;
}

}  // namespace sinew
