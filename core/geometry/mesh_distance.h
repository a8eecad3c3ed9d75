#pragma once
#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace sinew {

/// Exact signed distance to a closed triangle mesh. Pieces that are not connected count as a union: inside any of
/// them is inside. Sign by angle-weighted pseudonormals (Baerentzen & Aanaes 2005), search in a tree of boxes.
class MeshDistance {
 public:
  struct Nearest {
    double distance_m = std::numeric_limits<double>::infinity();  ///< negative inside
    Eigen::Vector3d point = Eigen::Vector3d::Zero();              ///< of the surface
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();             ///< outwards there, unit
    /// In which direction the distance of `p`, that this is the nearest of, grows: on from the surface, on it the
    /// normal. Beside an edge or a corner the normal is a mean of the faces' and points elsewhere.
    Eigen::Vector3d outward(const Eigen::Vector3d& p) const;
  };

  /// @param mesh closed and facing outwards (isWatertight()); a bug of the caller otherwise if it has no triangle.
  explicit MeshDistance(const TriangleMesh& mesh);
  ~MeshDistance();
  MeshDistance(MeshDistance&&) noexcept;
  MeshDistance& operator=(MeshDistance&&) noexcept;

  /// The same triangles with the vertices of the mesh elsewhere, much sooner than made anew: the tree stays.
  MeshDistance movedTo(const std::vector<Eigen::Vector3d>& vertices) const;

  /// Nearest point of the surface of the piece that `p` is deepest in or closest to.
  Nearest nearest(const Eigen::Vector3d& p) const;
  /// Like nearest(p).distance_m inside the mesh's box; outside of it the distance to the box, which is no more. Quick
  /// there.
  double distanceAtLeast_m(const Eigen::Vector3d& p) const;
  /// 0 outside, else how deep inside [m]; quick for points outside the mesh's box.
  double depth_m(const Eigen::Vector3d& p) const;

 private:
  MeshDistance();
  struct Piece;
  std::vector<Piece> pieces_, cavities_;
};

}  // namespace sinew
