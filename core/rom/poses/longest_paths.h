#pragma once
#include <Eigen/Core>

#include "core/muscle/musculature.h"
#include "core/rom/poses/pose_set.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

/// Longest and shortest path of every unit over a stream of postures [m], in the order of the units.
struct PathLimits {
  Eigen::VectorXd longest_m, shortest_m;
};

/// Sweeps all units over all postures, a block at a time; the postures are not kept.
PathLimits longestPaths(const Skeleton& skeleton, const Musculature& musculature, const PoseStream& poses);

}  // namespace sinew
