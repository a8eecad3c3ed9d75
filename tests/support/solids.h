#pragma once
#include <cmath>
#include <numbers>

#include "core/geometry/triangle_mesh.h"

namespace sinew::test {

/// Closed ball as latitudes and longitudes; vertices on the sphere.
inline TriangleMesh ballMesh(const Eigen::Vector3d& center, double radius_m, int rings) {
  TriangleMesh mesh;
  const int around = 2 * rings;
  for (int i = 1; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * i / rings, turn = std::numbers::pi * k / rings;
      mesh.vertices.push_back(center + radius_m * Eigen::Vector3d{std::sin(polar) * std::cos(turn), std::cos(polar),
                                                                  -std::sin(polar) * std::sin(turn)});
    }
  mesh.vertices.push_back(center + radius_m * Eigen::Vector3d::UnitY());
  mesh.vertices.push_back(center - radius_m * Eigen::Vector3d::UnitY());
  const int top = (rings - 1) * around, bottom = top + 1;
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around;
    mesh.triangles.push_back({top, k, next});
    for (int i = 0; i + 2 < rings; ++i) {
      const int a = i * around + k, b = i * around + next, c = a + around, d = b + around;
      mesh.triangles.push_back({a, c, d});
      mesh.triangles.push_back({a, d, b});
    }
    mesh.triangles.push_back({bottom, (rings - 2) * around + next, (rings - 2) * around + k});
  }
  return mesh;
}

/// Box with its edges along the axes, faces outwards.
inline TriangleMesh boxMesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 4, 6}, {0, 6, 2},
                    {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}};
  return mesh;
}

}  // namespace sinew::test
