#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/geometry/triangle_mesh.h"

namespace sinew::test {

/// Closed surface over a torus-like grid: `point(i/n, j/m)` must be periodic in both arguments.
inline TriangleMesh periodicMesh(int n, int m, const std::function<Eigen::Vector3d(double, double)>& point) {
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) mesh.vertices.push_back(point(double(i) / n, double(j) / m));
  const auto at = [&](int i, int j) { return std::int32_t((i % n) * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// Torus about Y, facing outwards.
inline TriangleMesh torus(double ring_m, double tube_m, int n = 96, int m = 48) {
  constexpr double kTurn = 2 * std::numbers::pi;
  return periodicMesh(n, m, [=](double s, double t) -> Eigen::Vector3d {
    const double r = ring_m + tube_m * std::cos(kTurn * t);
    return {r * std::cos(kTurn * s), tube_m * std::sin(-kTurn * t), -r * std::sin(kTurn * s)};
  });
}

/// Ellipsoid with half axes `half`, facing outwards; `rings` from pole to pole.
inline TriangleMesh ellipsoid(const Eigen::Vector3d& half, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero(),
                              int rings = 48) {
  constexpr double kPi = std::numbers::pi;
  const int around = 2 * rings;
  TriangleMesh mesh;
  mesh.vertices.push_back(centre + Eigen::Vector3d{0, half.y(), 0});
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double polar = kPi * i / rings, azimuth = 2 * kPi * j / around;
      mesh.vertices.push_back(centre +
                              half.cwiseProduct(Eigen::Vector3d{std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                                                -std::sin(polar) * std::sin(azimuth)}));
    }
  mesh.vertices.push_back(centre - Eigen::Vector3d{0, half.y(), 0});
  const auto at = [&](int i, int j) { return std::int32_t(1 + (i - 1) * around + j % around); };
  const auto last = std::int32_t(mesh.vertices.size() - 1);
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({last, at(rings - 1, j + 1), at(rings - 1, j)});
    for (int i = 1; i < rings - 1; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace sinew::test
