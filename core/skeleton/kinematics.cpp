#include "core/skeleton/kinematics.h"

#include <numbers>

#include "core/error.h"
#include "core/skeleton/kinematics_internal.h"

namespace sinew {
namespace {

/// dexp: spatial angular velocity of exp([v]) per unit rate of v (left Jacobian of SO(3)).
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  Eigen::Matrix3d skew;
  skew << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  double a = 0.5 - angle * angle / 24, b = 1.0 / 6 - angle * angle / 120;
  if (angle > 1e-4) {
    a = (1 - std::cos(angle)) / (angle * angle);
    b = (angle - std::sin(angle)) / (angle * angle * angle);
  }
  return Eigen::Matrix3d::Identity() + a * skew + b * skew * skew;
}

/// Angle of the rotation R about `axis` (the twist of the swing-twist decomposition).
double twistAngle(const Eigen::Vector3d& rotation_vector, const Eigen::Vector3d& axis) {
  const Eigen::Quaterniond q{rotationFromVector<double>(rotation_vector)};
  return 2 * std::atan2(q.vec().dot(axis), q.w());
}

/// d(twist angle) per unit spatial angular velocity, a row vector.
Eigen::Vector3d twistRate(const Eigen::Vector3d& rotation_vector, const Eigen::Vector3d& axis) {
  const Eigen::Quaterniond q{rotationFromVector<double>(rotation_vector)};
  const double w = q.w(), s = q.vec().dot(axis);
  // dq/dt = (1/2) omega q: dw = -omega.v / 2, dv = (w omega + omega x v) / 2.
  const Eigen::Vector3d ds = 0.5 * (w * axis + q.vec().cross(axis));
  const Eigen::Vector3d dw = -0.5 * q.vec();
  return 2 * (w * ds - s * dw) / (w * w + s * s);
}

RigidTransform patellaPose(const PatellaDriver& d, const RigidTransform& X_WF, double knee_rad) {
  const double phi = d.glide(knee_rad)[0];
  RigidTransform X_FP = RigidTransform::Identity();
  const double a = d.start_rad - phi;
  X_FP.linear() = d.R_FK * rotationAbout<double>(Eigen::Vector3d::UnitZ(), -phi);
  X_FP.translation() = d.p_FK + d.R_FK * Eigen::Vector3d{std::cos(a), std::sin(a), 0} * d.radius_m;
  return X_WF * X_FP;
}

RigidTransform radiusPose(const RadiusDriver& d, const RigidTransform& X_WU, const Eigen::Vector3d& wrist) {
  RigidTransform X_UR = RigidTransform::Identity();
  X_UR.translation() = d.p_UR;
  X_UR.linear() = rotationAbout<double>(d.axis_U, std::numbers::pi / 2 + twistAngle(wrist, d.axis_U));
  return X_WU * X_UR;
}

Twist rotationThrough(const Eigen::Vector3d& w_W, const Eigen::Vector3d& p_W) {
  return {w_W, -w_W.cross(p_W)};
}

}  // namespace

std::vector<RigidTransform> segmentPoses(const Skeleton& skeleton, const Posture& q) {
  require(q.size() == skeleton.coordinateCount(), "posture has one entry a coordinate");
  std::vector<RigidTransform> X_PJ;
  for (const auto& joint : skeleton.joints) X_PJ.push_back(joint.X_PJ);
  auto X_WB = movingSegmentPoses<double>(skeleton, X_PJ, std::span<const double>{q.data(), std::size_t(q.size())});
  X_WB.resize(skeleton.segments.size());
  for (const auto& d : skeleton.patellae) X_WB[d.segment] = patellaPose(d, X_WB[d.femur], q[d.knee_coordinate]);
  for (const auto& d : skeleton.radii)
    X_WB[d.segment] = radiusPose(d, X_WB[d.ulna], q.segment<3>(skeleton.joints[d.wrist_joint].first_coordinate));
  return X_WB;
}

Kinematics kinematicsWithRates(const Skeleton& skeleton, const Posture& q,
                               const std::vector<Eigen::Matrix3d>& angular_rates_J) {
  Kinematics k{segmentPoses(skeleton, q), {}};
  k.motions.resize(skeleton.segments.size());
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const Joint& joint = skeleton.joints[i];
    auto& motions = k.motions[joint.child];
    RigidTransform X_WJ = joint.X_PJ;
    if (joint.parent >= 0) {
      motions = k.motions[joint.parent];
      X_WJ = k.X_WB[joint.parent] * joint.X_PJ;
    }
    int c = joint.first_coordinate;
    const Eigen::Vector3d p_W = k.X_WB[joint.child].translation();
    if (joint.type == JointType::Free)
      for (int axis = 0; axis < 3; ++axis)
        motions.push_back({c++, {Eigen::Vector3d::Zero(), X_WJ.linear().col(axis)}});
    for (int axis = 0; c < joint.first_coordinate + joint.coordinate_count; ++axis, ++c)
      motions.push_back({c, rotationThrough(X_WJ.linear() * angular_rates_J[i].col(axis), p_W)});
  }
  for (const auto& d : skeleton.patellae) {
    auto& motions = k.motions[d.segment] = k.motions[d.femur];
    const Eigen::Vector3d axis_W = k.X_WB[d.femur].linear() * d.R_FK.col(2);
    motions.push_back(
        {d.knee_coordinate, rotationThrough(-d.glide(q[d.knee_coordinate])[1] * axis_W, k.X_WB[d.femur] * d.p_FK)});
  }
  for (const auto& d : skeleton.radii) {
    auto& motions = k.motions[d.segment] = k.motions[d.ulna];
    const int first = skeleton.joints[d.wrist_joint].first_coordinate;
    const Eigen::Vector3d rate = twistRate(q.segment<3>(first), d.axis_U);
    const Eigen::Vector3d axis_W = k.X_WB[d.ulna].linear() * d.axis_U;
    for (int i = 0; i < 3; ++i)
      motions.push_back({first + i, rotationThrough(rate.dot(angular_rates_J[d.wrist_joint].col(i)) * axis_W,
                                                    k.X_WB[d.segment].translation())});
  }
  return k;
}

Kinematics kinematics(const Skeleton& skeleton, const Posture& q) {
  std::vector<Eigen::Matrix3d> rates;
  for (const auto& joint : skeleton.joints) {
    Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();
    if (joint.type == JointType::Revolute)
      rate.col(0) = skeleton.coordinates[joint.first_coordinate].axis;
    else
      rate = leftJacobian(q.segment<3>(joint.first_coordinate + (joint.type == JointType::Free ? 3 : 0)));
    rates.push_back(rate);
  }
  return kinematicsWithRates(skeleton, q, rates);
}

Eigen::Matrix3Xd pointJacobian(const Skeleton& skeleton, const Kinematics& k, int segment,
                               const Eigen::Vector3d& p_B) {
  Eigen::Matrix3Xd jacobian = Eigen::Matrix3Xd::Zero(3, skeleton.coordinateCount());
  const Eigen::Vector3d p_W = k.X_WB[segment] * p_B;
  for (const auto& [coordinate, twist] : k.motions[segment]) jacobian.col(coordinate) += twist.at(p_W);
  return jacobian;
}

}  // namespace sinew
