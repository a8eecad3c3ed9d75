#pragma once
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "core/skeleton/skeleton.h"
#include "imaging/xray/path_length.h"

namespace sinew {

/// Soft tissues around a posed skeleton as seen by X-rays: skin to fascia is fat, within it muscle; lungs and a few
/// gas bubbles in the gut. Smooth elliptic tubes along the limbs and the trunk, their girths those of a slim adult
/// (reference stature 1.74 m) grown with the segments' lengths. `X_WB` are the poses of the skeleton's segments.
std::vector<XrayVolume> softTissues(const Skeleton& skeleton, const std::vector<RigidTransform>& X_WB);

/// Closed ellipsoid with its radii along the axes of `X_WE`.
TriangleMesh ellipsoidMesh(const RigidTransform& X_WE, const Eigen::Vector3d& radii_m);

}  // namespace sinew
