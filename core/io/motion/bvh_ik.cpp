#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/io/motion/bvh_ik_internal.h"
#include "core/io/motion/bvh_roles_internal.h"

namespace sinew {
namespace {

constexpr double kPull = 1e-6;  ///< to where the solver started

}  // namespace

/// Every joint turned as its targets say, hinges as far as they can; joints without a target as in `otherwise`.
Posture BvhInverseKinematics::turned(const Posture& otherwise, const BvhTargets& targets) const {
  Posture q = otherwise;
  q.head<3>() = targets.p_WPelvis - skeleton_.joints[0].X_PJ.translation();
  std::vector<Eigen::Matrix3d> R_WB(skeleton_.joints.size());
  for (const Joint& joint : skeleton_.joints) {
    Eigen::Matrix3d R_WJ = joint.X_PJ.linear();
    if (joint.parent >= 0) R_WJ = R_WB[joint.parent] * R_WJ;
    const int r = joint.first_coordinate + (joint.type == JointType::Free ? 3 : 0);
    const bool hinge = joint.type == JointType::Revolute;
    const Eigen::Vector3d& axis = skeleton_.coordinates[r].axis;
    const auto target = std::ranges::find(targets.turns, joint.child, &BvhTargets::Turn::segment);
    if (target != targets.turns.end()) {
      const Eigen::Matrix3d R_JB = R_WJ.transpose() * target->R_WB;
      const Eigen::Quaterniond turn{R_JB};
      if (hinge)
        q[r] = std::remainder(2 * std::atan2(turn.vec().dot(axis), turn.w()), 2 * std::numbers::pi);
      else
        q.segment<3>(r) = vectorFromRotation(R_JB);
    }
    R_WB[joint.child] = R_WJ * (hinge ? rotationAbout<double>(axis, q[r])
                                      : rotationFromVector<double>(Eigen::Vector3d{q.segment<3>(r)}));
  }
  keepInside(q);
  return q;
}

Posture BvhInverseKinematics::solve(const Posture& otherwise, const BvhTargets& targets) const {
  const Posture start = turned(otherwise, targets);
  Posture q = start;
  double cost = costAt(q, start, targets), damping = kPull;
  for (int i = 0; i < options_.iterations && damping < 1e6; ++i) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(q.size(), q.size());
    Eigen::VectorXd g = kPull * (start - q);
    accumulate(q, targets, H, g);
    H.diagonal().array() += damping;
    for (int k = 0; k < 3; ++k) H.row(k).setZero(), H.col(k).setZero(), H(k, k) = 1, g[k] = 0;  // placed already
    const Eigen::VectorXd step = H.ldlt().solve(g);
    Posture tried = q + step;
    keepInside(tried);
    const double tried_cost = costAt(tried, start, targets);
    if (tried_cost > cost) {
      damping *= 10;
      continue;
    }
    q = tried;
    cost = tried_cost;
    damping = std::max(kPull, damping / 10);
    if (step.lpNorm<Eigen::Infinity>() < options_.tolerance) break;
  }
  return q;
}

double BvhInverseKinematics::costAt(const Posture& q, const Posture& start, const BvhTargets& targets) const {
  const auto X_WB = segmentPoses(skeleton_, q);
  double cost = kPull * (q - start).squaredNorm();
  for (const auto& t : targets.turns)
    cost += t.weight * t.weight * vectorFromRotation(turnBetween(t.R_WB, X_WB[t.segment].linear())).squaredNorm();
  for (const auto& d : targets.directions) {
    const Eigen::Vector3d along = X_WB[d.to].translation() - X_WB[d.from].translation();
    cost += (along.normalized() - d.direction_W).squaredNorm();
  }
  return cost;
}

void BvhInverseKinematics::accumulate(const Posture& q, const BvhTargets& targets, Eigen::MatrixXd& H,
                                      Eigen::VectorXd& g) const {
  const Kinematics k = kinematics(skeleton_, q);
  const auto add = [&](const Eigen::Matrix3Xd& J, const Eigen::Vector3d& residual, double weight) {
    H += weight * weight * J.transpose() * J;
    g -= weight * weight * J.transpose() * residual;
  };
  for (const auto& t : targets.turns) {
    Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, q.size());
    for (const SegmentMotion& m : k.motions[t.segment]) J.col(m.coordinate) += m.twist.w;
    add(J, vectorFromRotation(turnBetween(t.R_WB, k.X_WB[t.segment].linear())), t.weight);
  }
  for (const auto& d : targets.directions) {
    const Eigen::Vector3d along = k.X_WB[d.to].translation() - k.X_WB[d.from].translation();
    const double length = along.norm();
    const Eigen::Vector3d u = along / length;
    const Eigen::Matrix3Xd J = (Eigen::Matrix3d::Identity() - u * u.transpose()) / length *
                               (pointJacobian(skeleton_, k, d.to, Eigen::Vector3d::Zero()) -
                                pointJacobian(skeleton_, k, d.from, Eigen::Vector3d::Zero()));
    add(J, u - d.direction_W, 1);
  }
}

/// Hinges stay in the athlete's range; turns stay below half a turn, where the rotation vector is unique.
void BvhInverseKinematics::keepInside(Posture& q) const {
  for (const Joint& joint : skeleton_.joints) {
    const int r = joint.first_coordinate + (joint.type == JointType::Free ? 3 : 0);
    const Coordinate& c = skeleton_.coordinates[r];
    if (joint.type == JointType::Revolute)
      q[r] = std::clamp(q[r], c.athlete_min_rad, c.athlete_max_rad);
    else if (q.segment<3>(r).norm() > std::numbers::pi)
      q.segment<3>(r) = vectorFromRotation(rotationFromVector<double>(q.segment<3>(r)));
  }
}

}  // namespace sinew
