#pragma once
#include <Eigen/Geometry>

#include "core/skeleton/kinematics.h"

namespace sinew {

/// An orientation of a ball joint as Ryu et al. take it apart (ROM Editing): a twist about the bone's shaft, then the
/// shortest turn (swing) that takes the shaft to a direction. R_JB = R_swing R_twist, in the joint frame J.
struct TwistSwing {
  double twist_rad = 0;         ///< -pi..pi
  Eigen::Vector3d direction_J;  ///< of the shaft, unit
};

/// `shaft_J`: unit, the shaft in the zero posture (RomMapFrame). Where the shaft is reversed the swing is about any
/// normal of it.
TwistSwing twistSwingOf(const Eigen::Vector3d& shaft_J, const Eigen::Quaterniond& R_JB);
Eigen::Quaterniond rotationOf(const Eigen::Vector3d& shaft_J, const TwistSwing& twist_swing);
/// The shortest turn alone.
Eigen::Quaterniond swingTo(const Eigen::Vector3d& shaft_J, const Eigen::Vector3d& direction_J);

/// Between the entries of a posture (rotation vector) and quaternions; the vector's length is at most pi.
Eigen::Quaterniond quaternionFromVector(const Eigen::Vector3d& v_rad);
Eigen::Vector3d vectorFromQuaternion(const Eigen::Quaterniond& q);

}  // namespace sinew
