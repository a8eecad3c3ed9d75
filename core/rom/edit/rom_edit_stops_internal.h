#pragma once
#include <Eigen/Core>

#include "core/skeleton/skeleton.h"

namespace sinew {

/// An interval for each clinical angle of a ball joint.
struct StopBox {
  Eigen::Vector3d min_rad, max_rad;
};

/// The box about an edited range: what coordinates say of it, and what other programs get.
StopBox boxAbout(const Skeleton& skeleton, int joint, const EditedRange& range);

}  // namespace sinew
