#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/skeleton/skeleton.h"

namespace sinew {

/// All 50 entries of a posture: per joint what its type needs - the root 3 translations [m] and a rotation vector
/// [rad], a ball joint the rotation vector (exponential map) of the child relative to its zero orientation, a
/// revolute joint its angle [rad].
using Posture = Eigen::VectorXd;
inline Posture zeroPosture(const Skeleton& skeleton) {
  return Posture::Zero(skeleton.coordinateCount());
}

/// Pose X_WB of every segment, driven ones included. `X_PJ` are the joint frames (of a deformed skeleton, say); T is
/// double or an automatic-differentiation scalar. Driven segments need doubles: see kinematics().
template <class T>
std::vector<RigidTransformT<T>> movingSegmentPoses(const Skeleton& skeleton, std::span<const RigidTransformT<T>> X_PJ,
                                                   std::span<const T> q) {
  std::vector<RigidTransformT<T>> X_WB(skeleton.joints.size());
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const Joint& joint = skeleton.joints[i];
    const T* x = &q[joint.first_coordinate];
    RigidTransformT<T> X_JB = RigidTransformT<T>::Identity();
    if (joint.type == JointType::Revolute) {
      X_JB.linear() = rotationAbout<T>(skeleton.coordinates[joint.first_coordinate].axis, x[0]);
    } else {
      const int r = joint.type == JointType::Free ? 3 : 0;
      if (r) X_JB.translation() = Vector3<T>{x[0], x[1], x[2]};
      X_JB.linear() = rotationFromVector<T>(Vector3<T>{x[r], x[r + 1], x[r + 2]});
    }
    const RigidTransformT<T> X_PB = X_PJ[i] * X_JB;
    X_WB[joint.child] = joint.parent < 0 ? X_PB : X_WB[joint.parent] * X_PB;
  }
  return X_WB;
}

/// Instantaneous motion of a body per unit rate of one coordinate, in W: velocity of a point p is v + w x p.
struct Twist {
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< of the body point that is at the world origin
  Eigen::Vector3d at(const Eigen::Vector3d& p_W) const { return v + w.cross(p_W); }
};

/// Motion of one segment with one coordinate.
struct SegmentMotion {
  int coordinate;
  Twist twist;
};

/// Where every segment is, and how it moves with every coordinate.
struct Kinematics {
  std::vector<RigidTransform> X_WB;                 ///< by segment
  std::vector<std::vector<SegmentMotion>> motions;  ///< by segment: the coordinates that move it
};

/// Forward kinematics with analytic derivatives; driven segments included.
Kinematics kinematics(const Skeleton& skeleton, const Posture& q);

/// Poses alone: about half the work.
std::vector<RigidTransform> segmentPoses(const Skeleton& skeleton, const Posture& q);

/// dp_W/dq, 3 x 50, of the point p_B fixed to a segment.
Eigen::Matrix3Xd pointJacobian(const Skeleton& skeleton, const Kinematics& k, int segment,
                               const Eigen::Vector3d& p_B);

}  // namespace sinew
