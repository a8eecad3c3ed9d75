#pragma once
#include <Eigen/Core>
#include <functional>

#include "core/geometry/triangle_mesh.h"

namespace sinew {

/// Closed surface on which `field` is zero, triangles facing positive values, from samples on a cubic lattice of
/// `cell_m` that covers `lower` to `upper` (marching tetrahedra: Doi & Koide 1991, on Kuhn's division of the cube, so
/// that neighbouring cells always agree). `field` must be positive outside that box; it is called from two threads.
/// Flat triangles between sampled edges: a ball of radius r is missed by up to cell^2 / (4 r).
TriangleMesh isosurface(const std::function<double(const Eigen::Vector3d&)>& field, const Eigen::Vector3d& lower,
                        const Eigen::Vector3d& upper, double cell_m);

}  // namespace sinew
