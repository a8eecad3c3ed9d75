#include "core/passive/structure_moments.h"

#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

double energy_J(const PassiveMoments& moments, int first, const Eigen::Vector3d& angles) {
  double energy_J = 0;
  for (int i = 0; i < 3; ++i) energy_J += passiveEnergy_J(moments[std::size_t(first + i)], angles[i]);
  return energy_J;
}

/// Angles of a ball joint in the reading of the lesser energy, and how their rates follow those of the usual reading:
/// the other one is (a + pi, const - b, c + pi).
struct BallReading {
  Eigen::Vector3d angles, rate_signs;
};

BallReading readingOf(const Skeleton& skeleton, const PassiveMoments& moments, const Joint& joint,
                      const Posture& posture) {
  const int first = joint.first_coordinate;
  const auto readings = clinicalReadings(skeleton, joint, rotationFromVector<double>(posture.segment<3>(first)));
  if (energy_J(moments, first, readings[0]) <= energy_J(moments, first, readings[1]))
    return {readings[0], Eigen::Vector3d::Ones()};
  return {readings[1], {1, -1, 1}};
}

}  // namespace

Eigen::VectorXd structureMoments_Nm(const Skeleton& skeleton, const PassiveMoments& moments, const Posture& posture) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(skeleton.coordinateCount());
  if (moments.empty()) return result;
  for (const Joint& joint : skeleton.joints) {
    const int first = joint.first_coordinate;
    if (joint.type == JointType::Revolute) {
      result[first] = passiveMoment_Nm(moments[std::size_t(first)], posture[first]);
    } else if (joint.type == JointType::Ball) {
      const BallReading reading = readingOf(skeleton, moments, joint, posture);
      for (int i = 0; i < 3; ++i)
        result[first + i] =
            reading.rate_signs[i] * passiveMoment_Nm(moments[std::size_t(first + i)], reading.angles[i]);
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
