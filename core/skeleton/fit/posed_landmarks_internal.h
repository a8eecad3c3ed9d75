#pragma once
#include <span>
#include <vector>

#include "core/skeleton/kinematics.h"
#include "core/skeleton/shape/bone_field.h"

namespace sinew {

/// Pose of every moving segment of the body of this shape in this posture. T is double or an
/// automatic-differentiation scalar.
template <class T>
std::vector<RigidTransformT<T>> posedSegments(const Skeleton& reference, const std::vector<T>& parameters,
                                              std::span<const T> q) {
  std::vector<RigidTransformT<T>> X_PJ(reference.joints.size());
  for (std::size_t j = 0; j < X_PJ.size(); ++j)
    X_PJ[j] = deformedJointFrame(reference, parameters, static_cast<int>(j));
  return movingSegmentPoses<T>(reference, X_PJ, q);
}

/// World positions of reference landmarks, in the order of `landmarks` (indices into skeleton.landmarks), on the body
/// of this shape in this posture. T is double or an automatic-differentiation scalar. Landmarks of driven segments
/// (patella, radius) are not served.
template <class T>
std::vector<Vector3<T>> posedLandmarks(const Skeleton& reference, std::span<const int> landmarks,
                                       const std::vector<T>& parameters, std::span<const T> q) {
  const auto X_WB = posedSegments<T>(reference, parameters, q);
  std::vector<Vector3<T>> points;
  points.reserve(landmarks.size());
  for (const int index : landmarks) {
    const Landmark& landmark = reference.landmarks[index];
    points.push_back(X_WB[landmark.segment] * deform(reference, parameters, landmark.segment, landmark.p_BL));
  }
  return points;
}

}  // namespace sinew
