#pragma once
#include <Eigen/Geometry>

namespace sinew {

/// X_AB: pose of frame B in frame A; p_AQ = X_AB * p_BQ. T is double or an automatic-differentiation scalar.
template <class T>
using RigidTransformT = Eigen::Transform<T, 3, Eigen::Isometry>;
using RigidTransform = RigidTransformT<double>;

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

/// exp([v]): rotation by |v| radians about v. Smooth at zero, so that derivatives exist there.
template <class T>
Matrix3<T> rotationFromVector(const Vector3<T>& v_rad) {
  using std::cos, std::sin, std::sqrt;
  const T angle2 = v_rad.squaredNorm();
  Matrix3<T> skew;
  skew << T(0), -v_rad.z(), v_rad.y(), v_rad.z(), T(0), -v_rad.x(), -v_rad.y(), v_rad.x(), T(0);
  T a, b;  // sin(t)/t and (1 - cos t)/t^2
  if (angle2 > T(1e-8)) {
    const T angle = sqrt(angle2);
    a = sin(angle) / angle;
    b = (T(1) - cos(angle)) / angle2;
  } else {
    a = T(1) - angle2 / T(6);
    b = T(0.5) - angle2 / T(24);
  }
  return Matrix3<T>::Identity() + a * skew + b * skew * skew;
}

/// Rotation about a unit axis.
template <class T>
Matrix3<T> rotationAbout(const Eigen::Vector3d& axis, const T& angle_rad) {
  return rotationFromVector<T>(axis.cast<T>() * angle_rad);
}

/// Inverse of rotationFromVector, in the ball of radius pi.
Eigen::Vector3d vectorFromRotation(const Eigen::Matrix3d& R);

}  // namespace sinew
