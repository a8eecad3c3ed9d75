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

}  // namespace sinew
