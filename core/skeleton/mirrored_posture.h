#pragma once
#include <Eigen/Core>

#include "core/skeleton/skeleton.h"

namespace sinew {

/// The same posture seen in the mirror: sides change places, what leans to the right leans to the left. Clinical
/// coordinates, in the order of Skeleton::coordinates.
Eigen::VectorXd mirroredClinical(const Skeleton& skeleton, const Eigen::VectorXd& clinical);

/// The coordinate of the other side; itself on the midline.
int mirroredCoordinate(const Skeleton& skeleton, int coordinate);

}  // namespace sinew
