#pragma once
#include <Eigen/Core>
#include <optional>

#include "core/foreign/foreign_model.h"

namespace sinew {

/// How a straight piece of a path lies over an obstacle; points in the obstacle's frame O.
struct WrapContact {
  Eigen::Vector3d p_OFirst, p_OLast;  ///< where it touches and leaves
  double arc_m = 0;                   ///< between them, on the surface
  double length_m = 0;                ///< of the whole way
};

/// The way from S to E over the obstacle; nullopt if the straight line is free.
///
/// Cylinder: the helix that is tangent at both ends, a shortest path. It wraps if the line cuts the cylinder; with a
/// side also if the line passes on the other side and at least one end is on the side. No wrap if both contacts are
/// beyond the cylinder's ends.
/// Ellipsoid: the shortest way in a plane through S and E (found by search over the planes), which for a sphere is
/// the shortest of all. It wraps only if the line cuts the ellipsoid; if that way is not on the asked-for side, the
/// opposite one in the plane of the centre is taken.
/// Neither wraps if S or E is inside.
std::optional<WrapContact> wrapOver(const WrapObject& object, const Eigen::Vector3d& p_OS,
                                    const Eigen::Vector3d& p_OE);

}  // namespace sinew
