#include "core/skeleton/clinical_angles.h"

#include <cmath>
#include <numbers>

#include "core/angle.h"
#include "core/error.h"
#include "core/skeleton/kinematics_internal.h"

namespace sinew {
namespace {

/// First rotational coordinate of a joint and its axes (1 or 3).
int firstRotation(const Joint& joint) {
  return joint.first_coordinate + (joint.type == JointType::Free ? 3 : 0);
}

const Eigen::Vector3d& axis(const Skeleton& skeleton, const Joint& joint, int i) {
  return skeleton.coordinates[firstRotation(joint) + i].axis;
}

/// Signed angle about unit `n` that takes u to v, both projected on the plane normal to n; 0 if one vanishes.
double angleAbout(const Eigen::Vector3d& n, const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  const Eigen::Vector3d up = u - n * n.dot(u), vp = v - n * n.dot(v);
  if (up.norm() < 1e-9 || vp.norm() < 1e-9) return 0;
  return std::atan2(n.dot(up.cross(vp)), up.dot(vp));
}

/// The two triples a, b, c with R = Rot(e1, a) Rot(e2, b) Rot(e3, c), that with the smaller |b| first; e2 is normal
/// to e3, e1 may be oblique (forearm axis). Where e1 and the turned e3 align, a is set to 0 and c takes the rest.
std::array<Eigen::Vector3d, 2> sequenceAngles(const Eigen::Matrix3d& R, const Eigen::Vector3d& e1,
                                              const Eigen::Vector3d& e2, const Eigen::Vector3d& e3) {
  // e1 . R e3 = A cos b + B sin b does not depend on a and c.
  const double A = e1.dot(e3), B = e1.dot(e2.cross(e3)), amplitude = std::hypot(A, B);
  const double phase = std::atan2(B, A);
  const double open = std::acos(std::clamp(e1.dot(R * e3) / amplitude, -1.0, 1.0));
  const auto wrapped = [](double x) { return std::remainder(x, 2 * std::numbers::pi); };
  const auto with = [&](double b) {
    const Eigen::Matrix3d R2 = rotationAbout<double>(e2, b);
    const double a = angleAbout(e1, R2 * e3, R * e3);
    const Eigen::Matrix3d R3 = (rotationAbout<double>(e1, a) * R2).transpose() * R;
    return Eigen::Vector3d{a, b, angleAbout(e3, e2, R3 * e2)};
  };
  const double b1 = wrapped(phase + open), b2 = wrapped(phase - open);
  if (std::abs(b1) < std::abs(b2)) return {with(b1), with(b2)};
  return {with(b2), with(b1)};
}

Eigen::Matrix3d sequenceRotation(const Skeleton& skeleton, const Joint& joint, const Eigen::Vector3d& angles) {
  return rotationAbout<double>(axis(skeleton, joint, 0), angles[0]) *
         rotationAbout<double>(axis(skeleton, joint, 1), angles[1]) *
         rotationAbout<double>(axis(skeleton, joint, 2), angles[2]);
}

}  // namespace

Eigen::Vector3d clinicalAngles(const Skeleton& skeleton, const Joint& joint, const Eigen::Matrix3d& R_JB) {
  return clinicalReadings(skeleton, joint, R_JB)[0];
}

std::array<Eigen::Vector3d, 2> clinicalReadings(const Skeleton& skeleton, const Joint& joint,
                                                const Eigen::Matrix3d& R_JB) {
  return sequenceAngles(R_JB, axis(skeleton, joint, 0), axis(skeleton, joint, 1), axis(skeleton, joint, 2));
}

Eigen::VectorXd clinicalFromPosture(const Skeleton& skeleton, const Posture& q) {
  Eigen::VectorXd clinical = q;
  for (const auto& joint : skeleton.joints) {
    if (joint.type == JointType::Revolute) continue;
    const int r = firstRotation(joint);
    clinical.segment<3>(r) = clinicalAngles(skeleton, joint, rotationFromVector<double>(q.segment<3>(r)));
  }
  return clinical;
}

Posture postureFromClinical(const Skeleton& skeleton, const Eigen::VectorXd& clinical) {
  require(clinical.size() == skeleton.coordinateCount(), "one entry a coordinate");
  Posture q = clinical;
  for (const auto& joint : skeleton.joints) {
    if (joint.type == JointType::Revolute) continue;
    const int r = firstRotation(joint);
    q.segment<3>(r) = vectorFromRotation(sequenceRotation(skeleton, joint, clinical.segment<3>(r)));
  }
  return q;
}

Posture postureFromDegrees(const Skeleton& skeleton, const std::map<std::string, double>& coordinates_deg) {
  Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
  for (const auto& [name, value] : coordinates_deg) {
    const int i = skeleton.coordinateIndex(name);
    if (!std::isfinite(value)) throw InputError{{"posture", name, "a finite number", std::to_string(value)}};
    clinical[i] = skeleton.coordinates[i].translational ? value : value * kRadPerDeg;
  }
  return postureFromClinical(skeleton, clinical);
}

Kinematics clinicalKinematics(const Skeleton& skeleton, const Posture& q) {
  const Eigen::VectorXd clinical = clinicalFromPosture(skeleton, q);
  std::vector<Eigen::Matrix3d> rates;
  for (const auto& joint : skeleton.joints) {
    Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();
    rate.col(0) = axis(skeleton, joint, 0);
    if (joint.type != JointType::Revolute) {
      const Eigen::Vector3d angles = clinical.segment<3>(firstRotation(joint));
      const Eigen::Matrix3d R1 = rotationAbout<double>(axis(skeleton, joint, 0), angles[0]);
      rate.col(1) = R1 * axis(skeleton, joint, 1);
      rate.col(2) = R1 * rotationAbout<double>(axis(skeleton, joint, 1), angles[1]) * axis(skeleton, joint, 2);
    }
    rates.push_back(rate);
  }
  return kinematicsWithRates(skeleton, q, rates);
}

}  // namespace sinew
