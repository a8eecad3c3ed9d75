#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/muscle/musculature.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

/// Path points in the world [m], origin first.
std::vector<Eigen::Vector3d> pathPoints(const MusculotendonUnit& unit, const std::vector<RigidTransform>& X_WB);

/// Length of the polyline [m].
double pathLength(const MusculotendonUnit& unit, const std::vector<RigidTransform>& X_WB);

/// dl/dq over the coordinates that `k` is expressed in (all 50; zero where the unit does not span) [m/rad].
/// Exact for any blended point and for driven segments: tension f loads the skeleton with tau = -f dl/dq.
Eigen::VectorXd lengthGradient(const MusculotendonUnit& unit, const Kinematics& k);

/// Moment arm about every clinical coordinate [m], positive = the muscle increases the coordinate: -dl/d(coordinate),
/// with `clinical` = clinicalKinematics(). For a revolute joint this is the paper's moment arm.
inline Eigen::VectorXd momentArms(const MusculotendonUnit& unit, const Kinematics& clinical) {
  return -lengthGradient(unit, clinical);
}

}  // namespace sinew
