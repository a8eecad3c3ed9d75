#pragma once
// Field of lumbar spine and thorax. T: scalar of the parameters and of the result; U: scalar of the point, double or
// T.
#include "core/geometry/rigid_transform.h"

namespace sinew::field {

// Places in the flat list of shapeParameterNames().
constexpr int kTrunkElongation = 3, kTrunkExpansion = 4, kTrunkBend = 5;

/// Trunk segments: elongated along Y, expanded across, bent on a circular arc; half the bend over each segment.
inline double trunkLength(bool thorax) {
  return thorax ? 0.270 : 0.185;
}

/// Bend over the height y of the reference.
template <class T, class U>
T trunkAngle(const T* parameters, bool thorax, const U& y) {
  return parameters[kTrunkBend] * T(y) * T(0.5 / trunkLength(thorax));
}

/// The arc's point at this angle and arc length: (forward, up).
template <class T>
Eigen::Matrix<T, 2, 1> arcPoint(const T& angle, const T& arc) {
  using std::cos, std::sin;
  // (1 - cos a) / a and sin(a) / a, by series near the straight trunk.
  T forward = angle * T(0.5), upward = T(1) - angle * angle / T(6);
  if (angle > T(1e-4) || angle < T(-1e-4)) {
    forward = (T(1) - cos(angle)) / angle;
    upward = sin(angle) / angle;
  }
  return {arc * forward, arc * upward};
}

/// On the hollow side of the bend cross-sections meet in the centre of the arc. Up to half way there the depth stays
/// what it is; what lies beyond is drawn together so that nothing reaches it (C1, with a C1 inverse).
/// @param depth forward of the arc [m] @param curvature 1 / radius of the arc, positive = bent forward
constexpr double kFreeDepth = 0.5;
template <class T>
T hollowDepth(const T& depth, const T& curvature) {
  const T a = depth * curvature;
  if (a <= T(kFreeDepth)) return depth;
  const T t = (a - T(kFreeDepth)) / T(1 - kFreeDepth);
  return (T(kFreeDepth) + T(1 - kFreeDepth) * t / (T(1) + t)) / curvature;
}

template <class T>
T trunkCurvature(const T* parameters, bool thorax) {
  return parameters[kTrunkBend] * T(0.5 / trunkLength(thorax)) / parameters[kTrunkElongation];
}

template <class T, class U>
Matrix3<T> trunkRotation(const T* parameters, bool thorax, const U& y) {
  return rotationAbout<T>(-Eigen::Vector3d::UnitZ(), trunkAngle(parameters, thorax, y));
}

template <class T, class U>
Vector3<T> deformTrunk(const T* parameters, bool thorax, const Vector3<U>& p) {
  const T s = parameters[kTrunkExpansion];
  const Eigen::Matrix<T, 2, 1> arc =
      arcPoint<T>(trunkAngle(parameters, thorax, p.y()), parameters[kTrunkElongation] * T(p.y()));
  const T depth = hollowDepth<T>(s * T(p.x()), trunkCurvature(parameters, thorax));
  return Vector3<T>{arc.x(), arc.y(), T(0)} +
         trunkRotation(parameters, thorax, p.y()) * Vector3<T>{depth, T(0), s * T(p.z())};
}

}  // namespace sinew::field
