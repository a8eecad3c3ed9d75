#pragma once
#include <vector>

#include "core/skeleton/kinematics.h"

namespace sinew {

/// Kinematics whose rotational columns are given per joint: spatial angular velocity in the joint frame J per unit
/// rate of each of its rotational coordinates. Serves both the entries of q and the clinical angles.
Kinematics kinematicsWithRates(const Skeleton& skeleton, const Posture& q,
                               const std::vector<Eigen::Matrix3d>& angular_rates_J);

}  // namespace sinew
