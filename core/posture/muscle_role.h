#pragma once
#include <vector>

#include "core/muscle/musculature.h"
#include "core/posture/evaluate.h"
#include "core/skeleton/joint_motion.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// What a unit is for, read from the model itself: which joints its path crosses, which way it turns them at a posture
// (moment arms), and in which movements it shortens (its function in the sense of Ryu et al., Musculature
// Retargeting).

/// Clinical coordinates that move the path's points relative to each other; root and other segments' are left out.
/// @param clinical of any posture, from clinicalKinematics().
std::vector<int> spannedCoordinates(const MusculotendonUnit& unit, const Kinematics& clinical);

/// Joints of those coordinates, in the skeleton's order.
std::vector<int> crossedJoints(const Skeleton& skeleton, const std::vector<int>& spanned);

/// What a unit does about one coordinate at a posture.
struct MuscleAction {
  int coordinate = -1;
  double moment_arm_m = 0;  ///< positive = increases the coordinate
};
/// Actions of the unit with index `unit`, largest moment arm first; arms below `least_arm_m` are left out.
std::vector<MuscleAction> muscleActions(const PostureEvaluation& evaluation, int unit, double least_arm_m = 0.001);

/// A movement that the unit shortens in.
struct MuscleFunction {
  const JointMotion* motion = nullptr;  ///< points into the list given
  double shortening_m = 0;              ///< length at its start minus length at its end, > 0
};
/// Largest shortening first; what is below `least_m` is left out.
std::vector<MuscleFunction> muscleFunctions(const Skeleton& skeleton, const MusculotendonUnit& unit,
                                            const std::vector<JointMotion>& motions, double least_m = 0.002);

/// Units (indices) that turn a coordinate the wanted way at a posture with a moment arm of at least `least_arm_m`.
std::vector<int> agonists(const PostureEvaluation& evaluation, int coordinate, bool increase,
                          double least_arm_m = 0.005);

}  // namespace sinew
