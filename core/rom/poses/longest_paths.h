#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/job.h"
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

/// Longest path of every unit over a pose set [m]. Two threads and more; empty if the job was cancelled.
std::vector<double> longestOverPoses(const Skeleton& skeleton, const Musculature& musculature, const PoseSet& poses,
                                     const Job& job = {});

}  // namespace sinew
