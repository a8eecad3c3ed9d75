#include "core/geometry/rigid_transform.h"

namespace sinew {

Eigen::Vector3d vectorFromRotation(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q{R};
  if (q.w() < 0) q.coeffs() *= -1;
  const double s = q.vec().norm();
  if (s < 1e-12) return 2 * q.vec();
  return q.vec() * (2 * std::atan2(s, q.w()) / s);
}

}  // namespace sinew
