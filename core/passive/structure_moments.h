#pragma once
#include <Eigen/Core>

#include "core/passive/passive_moment.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// What the passive structures of all joints do at a posture. A ball joint's orientation can be read as two triples of
// clinical angles (clinicalReadings()); the one in which less energy is stored counts, as the better reading does for
// stops. The energy is a function of the posture alone, so that the moments do no work over a closed path.

/// Generalised forces by clinical coordinate, conjugate to the rates of clinicalFromPosture() - what moment arms and
/// passive torques are taken about too [N m]; positive = towards larger values. Zeros for empty `moments`.
Eigen::VectorXd structureMoments_Nm(const Skeleton& skeleton, const PassiveMoments& moments, const Posture& posture);

/// The energy that they store [J].
double structureEnergy_J(const Skeleton& skeleton, const PassiveMoments& moments, const Posture& posture);

/// Angular velocity in the joint frame per unit rate of each clinical angle of a ball joint, by column. Generalised
/// forces are its transposed times the moment vector there.
Eigen::Matrix3d angleRates(const Skeleton& skeleton, const Joint& joint, const Eigen::Vector3d& angles);

}  // namespace sinew
