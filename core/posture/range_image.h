#pragma once
#include <optional>
#include <vector>

#include "core/posture/twist_swing.h"
#include "core/skeleton/edited_range.h"

namespace sinew {

// T of the steps of an edited range, and its inverse, for one joint. The newest step is applied to a posture first.
// What T takes beyond half a turn has no image: it is outside of the edited range. (A hinge has one at half a turn.)

using RangeSteps = std::vector<RangeStep>;

double hingeImage(const RangeSteps& steps, double angle_rad);
double hingePreimage(const RangeSteps& steps, double angle_rad);

std::optional<double> twistImage(const RangeSteps& steps, double twist_rad);
std::optional<Eigen::Vector3d> directionImage(const RangeSteps& steps, const Eigen::Vector3d& direction_J);
/// Beyond half a turn: half a turn.
TwistSwing ballPreimage(const RangeSteps& steps, const TwistSwing& orientation);

/// T of an orientation of a ball joint.
std::optional<Eigen::Matrix3d> ballImage(const EditedRange& range, const Eigen::Matrix3d& R_JB);

}  // namespace sinew
