#pragma once
#include "core/geometry/triangle_mesh.h"

namespace sinew {

// What to do with a surface that another program made: join its corners, see whether it is closed, turn it outwards.

/// Vertices at exactly the same place become one (STL repeats them for every triangle); triangles that collapse by
/// that, and vertices that no triangle uses, go.
TriangleMesh welded(const TriangleMesh& mesh);

/// Edges that keep a surface from bounding a solid.
struct MeshDefects {
  int open_edges = 0;          ///< of one triangle: a hole
  int shared_edges = 0;        ///< of more than two triangles
  int contrary_edges = 0;      ///< of two triangles that run along it the same way
  bool turned_inside = false;  ///< closed, but the volume is negative
  bool closed() const { return open_edges == 0 && shared_edges == 0; }
  bool sound() const { return closed() && contrary_edges == 0 && !turned_inside; }
};
MeshDefects meshDefects(const TriangleMesh& mesh);

/// The same surface with its triangles counter-clockwise seen from outside. A consistent winding is kept or turned as
/// a whole (so that marrow cavities stay cavities); otherwise each connected part is turned by its own volume.
/// @pre meshDefects(mesh).closed(). @throws InputError for a one-sided surface.
TriangleMesh turnedOutwards(const TriangleMesh& mesh);

}  // namespace sinew
