#pragma once
#include <Eigen/Core>
#include <vector>

namespace sinew {

/// One change of a joint's range (core/rom/rom_edit.h): what T, which takes a posture of the edited range to one of
/// the range before, divides and shifts back. Of a hinge the angle; of a ball joint the twist about the shaft and the
/// cone of its directions.
struct RangeStep {
  double factor = 1, shift_rad = 0, centre_rad = 0;  ///< hinge angle, or twist
  double cone_factor = 1;
  Eigen::Vector3d centre_J = Eigen::Vector3d::Zero();
  Eigen::Matrix3d tilt_J = Eigen::Matrix3d::Identity();
  friend bool operator==(const RangeStep&, const RangeStep&) = default;
};

/// The range of a ball joint that was edited: an orientation is within its stops if T of it is within the stops that
/// the joint had before. What the coordinates say (Coordinate::stop_min_rad ...) is then the box about that range.
struct EditedRange {
  std::vector<RangeStep> steps;  ///< in the order of the edits; none: the range is the box of the coordinates' stops
  Eigen::Vector3d shaft_J = Eigen::Vector3d::Zero();  ///< what twists are about
  Eigen::Vector3d stop_min_rad = Eigen::Vector3d::Zero(), stop_max_rad = Eigen::Vector3d::Zero();  ///< before
  friend bool operator==(const EditedRange&, const EditedRange&) = default;
};

}  // namespace sinew
