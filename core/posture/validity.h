#pragma once
#include <string>
#include <vector>

#include "core/muscle/musculature.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// isValid of Ryu et al. (Muscle-induced ROM): a posture is valid if every constraint C_i(q) >= 0. Constraints are the
// longest length of every unit, C = 1.6 l0 + 1.03 l_slack - l(q), and the bony and ligament stops of every
// coordinate, C = stop - q towards the nearer end: the angle that is left until the structures of that end alone -
// capsule, ligament, bone - set their end moment against the joint (core/passive/structures.h). Short of a stop they
// push back already, beyond it ever more; the margin says how far off the end is, not that nothing holds before.

enum class ConstraintKind { MuscleLength, JointStop };

struct ConstraintMargin {
  ConstraintKind kind = ConstraintKind::MuscleLength;
  int index = -1;       ///< unit, or coordinate
  bool upper = true;    ///< of a stop: the upper end is the nearer one
  double margin = 0;    ///< C_i: metres of path, or radians; negative = violated
  double relative = 0;  ///< C_i in optimal fibre lengths, or in radians: what margins are compared by

  /// Violated only beyond rounding: postures are stored in single precision and may sit on a limit.
  bool holds() const { return margin >= (kind == ConstraintKind::MuscleLength ? -1e-9 : -1e-5); }
};

struct Validity {
  bool valid = false;
  ConstraintMargin first;                  ///< the one that is violated most, or that would be the next to fail
  std::vector<ConstraintMargin> violated;  ///< worst first
};

/// All constraints: units in their order, then coordinates (the free root has none).
std::vector<ConstraintMargin> constraintMargins(const Skeleton& skeleton, const Musculature& musculature,
                                                const Posture& posture);
/// Those of the joints alone. A ball joint's angles are read in whichever of the two ways lies deeper inside the
/// stops: beyond 90 deg of the middle angle (arm above the head) the usual reading flips.
std::vector<ConstraintMargin> stopMargins(const Skeleton& skeleton, const Posture& posture);

/// The least of a ball joint whose child is turned by R_JB, under the better reading [rad]. Of a joint whose range
/// was edited it is that of T of the orientation within the stops before (core/skeleton/edited_range.h): what maps,
/// clinical ranges and tests ask too.
double ballStopMargin_rad(const Skeleton& skeleton, const Joint& joint, const Eigen::Matrix3d& R_JB);

Validity validity(const Skeleton& skeleton, const Musculature& musculature, const Posture& posture);
Validity validityOf(const std::vector<ConstraintMargin>& margins);

/// "semimembranosus_r", "knee_flexion_r (stop, max)".
std::string nameOf(const ConstraintMargin& constraint, const Skeleton& skeleton, const Musculature& musculature);

}  // namespace sinew
