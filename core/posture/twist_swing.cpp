#include "core/posture/twist_swing.h"

#include <cmath>
#include <numbers>

namespace sinew {
namespace {

/// w and the vector part of a rotation by `angle_rad` about a unit axis.
Eigen::Quaterniond about(const Eigen::Vector3d& axis, double angle_rad) {
  const double s = std::sin(angle_rad / 2);
  return {std::cos(angle_rad / 2), s * axis.x(), s * axis.y(), s * axis.z()};
}

}  // namespace

TwistSwing twistSwingOf(const Eigen::Vector3d& shaft_J, const Eigen::Quaterniond& R_JB) {
  const double twist = 2 * std::atan2(R_JB.vec().dot(shaft_J), R_JB.w());
  return {std::remainder(twist, 2 * std::numbers::pi), (R_JB * shaft_J).normalized()};
}

Eigen::Quaterniond swingTo(const Eigen::Vector3d& shaft_J, const Eigen::Vector3d& direction_J) {
  const double w = 1 + shaft_J.dot(direction_J);
  if (w < 1e-12) return about(shaft_J.unitOrthogonal(), std::numbers::pi);
  const Eigen::Vector3d v = shaft_J.cross(direction_J);
  return Eigen::Quaterniond{w, v.x(), v.y(), v.z()}.normalized();
}

Eigen::Quaterniond rotationOf(const Eigen::Vector3d& shaft_J, const TwistSwing& twist_swing) {
  return swingTo(shaft_J, twist_swing.direction_J) * about(shaft_J, twist_swing.twist_rad);
}

Eigen::Quaterniond quaternionFromVector(const Eigen::Vector3d& v_rad) {
  const double angle = v_rad.norm();
  if (angle < 1e-12) return {1, v_rad.x() / 2, v_rad.y() / 2, v_rad.z() / 2};
  return about(v_rad / angle, angle);
}

Eigen::Vector3d vectorFromQuaternion(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1 : 1, s = q.vec().norm();
  if (s < 1e-12) return 2 * sign * q.vec();
  return (2 * std::atan2(s, sign * q.w()) * sign / s) * q.vec();
}

}  // namespace sinew
