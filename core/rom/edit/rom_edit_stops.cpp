#include "core/rom/edit/rom_edit_stops_internal.h"

#include <cmath>
#include <limits>

#include "core/posture/range_image.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr int kSteps = 12;  // of each stop's interval

/// Orientation with these clinical angles, before the edit.
Eigen::Quaterniond orientation(const Skeleton& skeleton, const Joint& joint, const Eigen::Vector3d& angles) {
  Eigen::Matrix3d R_JB = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i)
    R_JB *= rotationAbout<double>(skeleton.coordinates[joint.first_coordinate + i].axis, angles[i]);
  return Eigen::Quaterniond{R_JB};
}

}  // namespace

StopBox boxAbout(const Skeleton& skeleton, int joint, const EditedRange& range) {
  const Joint& j = skeleton.joints[joint];
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  StopBox box{Eigen::Vector3d::Constant(kInfinity), Eigen::Vector3d::Constant(-kInfinity)};
  const auto at = [&](int axis, int step) {
    return std::lerp(range.stop_min_rad[axis], range.stop_max_rad[axis], double(step) / kSteps);
  };
  const Eigen::Vector3d middle = (range.stop_min_rad + range.stop_max_rad) / 2;
  for (int a = 0; a <= kSteps; ++a)
    for (int b = 0; b <= kSteps; ++b)
      for (int c = 0; c <= kSteps; ++c) {
        const auto before = orientation(skeleton, j, {at(0, a), at(1, b), at(2, c)});
        const TwistSwing after = ballPreimage(range.steps, twistSwingOf(range.shaft_J, before));
        const auto readings = clinicalReadings(skeleton, j, rotationOf(range.shaft_J, after).toRotationMatrix());
        // The reading nearer to the middle of the range before: beyond 90 deg the usual one flips.
        const bool first = (readings[0] - middle).norm() <= (readings[1] - middle).norm();
        box.min_rad = box.min_rad.cwiseMin(readings[first ? 0 : 1]);
        box.max_rad = box.max_rad.cwiseMax(readings[first ? 0 : 1]);
      }
  return box;
}

}  // namespace sinew
