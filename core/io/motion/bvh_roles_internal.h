#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/angle.h"
#include "core/io/motion/bvh.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// Which joint of a CMU-style skeleton carries which of our segments; both the import and the export of motions ask.

/// A segment and the joint of the file that carries it.
struct BvhRole {
  const char* segment;
  std::vector<std::string> joints;  ///< names, the first that exists
  double turn_weight;               ///< how much the joint's turn counts; small where only the direction is sure
  bool required;
};
const std::vector<BvhRole>& bvhRoles();

/// What a rig at rest looks like: arms sideways from a girdle that hangs as in standing.
Posture restOfRigs(const Skeleton& skeleton);

inline Eigen::Matrix3d turnBetween(const Eigen::Matrix3d& R_WA, const Eigen::Matrix3d& R_WB) {
  return R_WB * R_WA.transpose();
}

}  // namespace sinew
