#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "core/geometry/triangle_mesh.h"
#include "core/geometry/view.h"

namespace sinew {

/// A line in the image [px]; closed if its last point equals its first.
using ImageLine = std::vector<Eigen::Vector2d>;

/// Direction of the photons that pass the point p_W [unit vector, from the source towards the detector].
Eigen::Vector3d rayDirectionAt(const View& view, const Eigen::Vector3d& p_W);

/// Contours of a posed bone as a radiograph shows them: where the rays graze the surface, hidden parts included, for
/// X-rays see through. On every triangle the line n . d = 0 of the interpolated vertex normals n and ray directions d
/// (Hertzmann & Zorin 2000, SIGGRAPH: smooth silhouettes), chained across triangles; closed loops for a closed mesh.
/// Loops shorter than `min_length_px` are left out; so are lines through points that cannot be projected.
std::vector<ImageLine> silhouette(const TriangleMesh& mesh, const RigidTransform& X_WB, const View& view,
                                  double min_length_px = 0);

/// Length of a line [px].
double lengthOf(const ImageLine& line);

}  // namespace sinew
