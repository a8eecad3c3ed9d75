#include "core/passive/structure_moments.h"

#include <Eigen/LU>

#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

double energy_J(const PassiveMoments& moments, int first, const Eigen::Vector3d& angles) {
  double energy_J = 0;
  for (int i = 0; i < 3; ++i) energy_J += passiveEnergy_J(moments[std::size_t(first + i)], angles[i]);
  return energy_J;
}

/// Angles of a ball joint in the reading of the lesser energy, and the usual ones.
struct BallReading {
  Eigen::Vector3d angles, usual;
};

BallReading readingOf(const Skeleton& skeleton, const PassiveMoments& moments, const Joint& joint,
                      const Posture& posture) {
  const int first = joint.first_coordinate;
  const auto readings = clinicalReadings(skeleton, joint, rotationFromVector<double>(posture.segment<3>(first)));
  const bool usual = energy_J(moments, first, readings[0]) <= energy_J(moments, first, readings[1]);
  return {readings[usual ? 0 : 1], readings[0]};
}

/// Generalised forces of a ball joint by its usual angles. Both readings turn the child alike, so that the moment
/// vector is the same: rates' transposed times vector = generalised forces, in either.
Eigen::Vector3d ballMoments_Nm(const Skeleton& skeleton, const PassiveMoments& moments, const Joint& joint,
                               const Posture& posture) {
  const BallReading reading = readingOf(skeleton, moments, joint, posture);
  Eigen::Vector3d forces;
  for (int i = 0; i < 3; ++i)
    forces[i] = passiveMoment_Nm(moments[std::size_t(joint.first_coordinate + i)], reading.angles[i]);
  if (reading.angles == reading.usual) return forces;
  const Eigen::Matrix3d own = angleRates(skeleton, joint, reading.angles);
  return angleRates(skeleton, joint, reading.usual).transpose() * own.transpose().partialPivLu().solve(forces);
}

}  // namespace

Eigen::Matrix3d angleRates(const Skeleton& skeleton, const Joint& joint, const Eigen::Vector3d& angles) {
  const auto axis = [&](int i) { return skeleton.coordinates[std::size_t(joint.first_coordinate + i)].axis; };
  const Eigen::Matrix3d R1 = rotationAbout<double>(axis(0), angles[0]);
  Eigen::Matrix3d rates;
  rates << axis(0), R1 * axis(1), R1 * rotationAbout<double>(axis(1), angles[1]) * axis(2);
  return rates;
}

Eigen::VectorXd structureMoments_Nm(const Skeleton& skeleton, const PassiveMoments& moments, const Posture& posture) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(skeleton.coordinateCount());
  if (moments.empty()) return result;
  for (const Joint& joint : skeleton.joints) {
    const int first = joint.first_coordinate;
    if (joint.type == JointType::Revolute) {
      result[first] = passiveMoment_Nm(moments[std::size_t(first)], posture[first]);
    } else if (joint.type == JointType::Ball) {
      result.segment<3>(first) = ballMoments_Nm(skeleton, moments, joint, posture);
    }
  }
  return result;
}

double structureEnergy_J(const Skeleton& skeleton, const PassiveMoments& moments, const Posture& posture) {
  double sum_J = 0;
  for (const Joint& joint : skeleton.joints) {
    const int first = joint.first_coordinate;
    if (moments.empty() || joint.type == JointType::Free) continue;
    sum_J += joint.type == JointType::Revolute
                 ? passiveEnergy_J(moments[std::size_t(first)], posture[first])
                 : energy_J(moments, first, readingOf(skeleton, moments, joint, posture).angles);
  }
  return sum_J;
}

}  // namespace sinew
