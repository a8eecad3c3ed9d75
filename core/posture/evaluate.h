#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/muscle/musculature.h"
#include "core/passive/passive_moment.h"
#include "core/posture/validity.h"
#include "core/skeleton/joint_motion.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// Quantities of all units at a posture, and of one unit over a joint motion: what `sinew evaluate`, `sinew curve`,
// plots and reports show. Vectors by unit follow Musculature::units, by coordinate Skeleton::coordinates.

/// A unit that is stretched beyond its longest length (negative margin), or how much is left.
struct LengthMargin {
  int unit = -1;
  double margin_m = 0;  ///< longest minus present path length
};

struct PostureEvaluation {
  Eigen::VectorXd length_m;                 ///< path length by unit
  Eigen::MatrixXd moment_arm_m;             ///< unit x clinical coordinate; positive = the unit increases it
  Eigen::VectorXd normalized_fiber_length;  ///< passive equilibrium, by unit
  Eigen::VectorXd passive_force_N;          ///< along the tendon, by unit
  Eigen::VectorXd structure_torque;         ///< of capsules and ligaments, by clinical coordinate [N m]
  Eigen::VectorXd passive_torque;           ///< units and structures together, likewise [N m; N for translations]
  bool valid = false;                       ///< every constraint holds (core/rom/validity.h)
  ConstraintMargin first_to_fail;           ///< the constraint that is violated most, or would be the next
  std::vector<LengthMargin> margins;        ///< smallest first
  std::vector<std::string> coordinates_beyond_envelope;  ///< beyond the body's own stops
};

/// Everything at one posture. `structures`: Model::passive_moments; a body without has no structure torques.
PostureEvaluation evaluatePosture(const Skeleton& skeleton, const Musculature& musculature, const Posture& posture,
                                  const PassiveMoments& structures = {});

/// Fibres, passive forces and torques of an evaluation that has lengths and moment arms, and structure torques if
/// any.
void fillPassive(const Musculature& musculature, PostureEvaluation& evaluation);

/// The torque about every clinical coordinate when all units that turn that way are fully active and hold still:
/// sum of moment arm * force at activation 1, passive share included; the other units are left out.
struct IsometricTorque {
  Eigen::VectorXd increasing_Nm;  ///< >= 0 [N for translations]
  Eigen::VectorXd decreasing_Nm;  ///< <= 0
};
IsometricTorque isometricTorque(const Musculature& musculature, const PostureEvaluation& evaluation);

/// One unit over a joint motion, sampled evenly in theta.
struct MotionCurve {
  std::vector<double> theta;  ///< 0 .. 1
  std::vector<double> angle_deg;
  std::vector<double> length_m;
  std::vector<double> moment_arm_m;             ///< about the moved coordinate, positive = increases it
  std::vector<double> normalized_fiber_length;  ///< passive
  std::vector<double> passive_force_N;
  std::vector<double> active_force_N;  ///< share of the active element at full activation
  std::vector<double> full_torque_Nm;  ///< about the moved coordinate at full activation, passive share included
};
/// Adds one sample: what a unit of this length and moment arm does.
void appendSample(const MusculotendonUnit& unit, double theta, double angle_deg, double length_m, double moment_arm_m,
                  MotionCurve& curve);
/// @param samples at least 2 (a bug of the caller otherwise).
MotionCurve motionCurve(const Skeleton& skeleton, const MusculotendonUnit& unit, const JointMotion& motion,
                        int samples = 101);

}  // namespace sinew
