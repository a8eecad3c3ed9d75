#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/skeleton/kinematics.h"

namespace sinew {

/// A named movement of one joint, from a start to an end posture: what function, length curves and peak torque are
/// judged over. theta in [0, 1] interpolates the clinical coordinates linearly.
struct JointMotion {
  std::string name;                                 ///< "knee_flexion_r"; a motion of the midline has no side
  std::string title;                                ///< "knee flexion"
  std::string joint;                                ///< "knee_r"
  std::string coordinate;                           ///< clinical coordinate that moves: "knee_flexion_r"
  double start_deg = 0, end_deg = 0;                ///< of that coordinate
  std::map<std::string, double> other_posture_deg;  ///< held all the way; what is not named is 0

  double angle_deg(double theta) const { return start_deg + theta * (end_deg - start_deg); }
};

/// Reads skeleton/joint_motions.json: every sided motion for the right and for the left.
/// @throws InputError naming file, motion, field; also for a coordinate that `skeleton` does not have.
std::vector<JointMotion> loadJointMotions(const std::filesystem::path& resource_dir, const Skeleton& skeleton);

/// Motion by name; without a side ("knee_flexion", or its title "knee flexion") the one of `side` ('r' or 'l').
/// @throws InputError with the nearest names.
const JointMotion& findMotion(const std::vector<JointMotion>& motions, std::string_view name, char side = 'r');

/// By motion: the one that is it seen in the mirror - of the other side, or to the other side; -1 if none is.
std::vector<int> mirrorMotions(const Skeleton& skeleton, const std::vector<JointMotion>& motions);

/// Posture at theta.
Posture motionPosture(const Skeleton& skeleton, const JointMotion& motion, double theta);

}  // namespace sinew
