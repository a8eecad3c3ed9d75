#include "core/geometry/mesh_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace sinew {
namespace {

using Eigen::Vector3d;

TriangleMesh cube(const Vector3d& low, double side) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(low + side * Vector3d{double(i & 1), double((i >> 1) & 1), double(i >> 2)});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto offset = static_cast<std::int32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + offset, j + offset, k + offset});
  return a;
}

/// Exact signed distance to the cube [low, low + side]^3.
double cubeDistance(const Vector3d& p, const Vector3d& low, double side) {
  const Vector3d q = (p - low - Vector3d::Constant(side / 2)).cwiseAbs() - Vector3d::Constant(side / 2);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

TEST(MeshDistance, IsTheDistanceToACubeAnywhere) {
  const TriangleMesh mesh = cube({0, 0, 0}, 1);
  ASSERT_TRUE(isWatertight(mesh));
  ASSERT_GT(signedVolume_m3(mesh), 0);
  const MeshDistance distance{mesh};
  std::mt19937 random{1};
  std::uniform_real_distribution<double> at{-1, 2};
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p{at(random), at(random), at(random)};
    const auto nearest = distance.nearest(p);
    EXPECT_NEAR(nearest.distance_m, cubeDistance(p, {0, 0, 0}, 1), 1e-12);
    EXPECT_NEAR((p - nearest.point).norm(), std::abs(nearest.distance_m), 1e-12);
    EXPECT_NEAR(distance.depth_m(p), std::max(0.0, -cubeDistance(p, {0, 0, 0}, 1)), 1e-12);
  }
}

TEST(MeshDistance, OutwardsIsWhereTheDistanceGrows) {
  const MeshDistance distance{cube({0, 0, 0}, 1)};
  const Vector3d beside_corner{1.1, 1.2, 1.3}, inside{0.5, 0.5, 0.9}, on_face{0.25, 0.5, 1};
  EXPECT_LT((distance.nearest(beside_corner).outward(beside_corner) - Vector3d{1, 2, 3}.normalized()).norm(), 1e-12);
  EXPECT_LT((distance.nearest(inside).outward(inside) - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((distance.nearest(on_face).outward(on_face) - Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(MeshDistance, NormalPointsOutwardsOnFacesEdgesAndCorners) {
  const MeshDistance distance{cube({0, 0, 0}, 1)};
  EXPECT_NEAR((distance.nearest({0.3, 0.4, 1.5}).normal - Vector3d::UnitZ()).norm(), 0, 1e-12);
  EXPECT_NEAR((distance.nearest({0.3, 0.4, 0.9}).normal - Vector3d::UnitZ()).norm(), 0, 1e-12);
  EXPECT_NEAR((distance.nearest({2, 2, 2}).normal - Vector3d::Ones().normalized()).norm(), 0, 1e-12);
}

TEST(MeshDistance, OverlappingPiecesAreAUnion) {
  // Between the two faces that lie inside the other cube a single search would call the middle outside.
  const MeshDistance distance{together(cube({0, 0, 0}, 1), cube({0.8, 0.1, 0.1}, 1))};
  const Vector3d in_both{0.9, 0.5, 0.5};
  EXPECT_NEAR(distance.nearest(in_both).distance_m, -0.1, 1e-12);
  EXPECT_NEAR(distance.depth_m(in_both), 0.1, 1e-12);
  const Vector3d in_first{0.7, 0.5, 0.5};
  EXPECT_NEAR(distance.nearest(in_first).distance_m, -0.3, 1e-12);
  EXPECT_GT(distance.nearest({-0.2, 0.5, 0.5}).distance_m, 0);
}

TEST(MeshDistance, ACavityIsOutside) {
  TriangleMesh hole = cube({0.25, 0.25, 0.25}, 0.5);
  for (auto& t : hole.triangles) std::swap(t[1], t[2]);
  const MeshDistance shell{together(cube({0, 0, 0}, 1), hole)};
  EXPECT_NEAR(shell.nearest({0.5, 0.5, 0.5}).distance_m, 0.25, 1e-12);    // in the hole
  EXPECT_NEAR(shell.nearest({0.5, 0.5, 0.15}).distance_m, -0.10, 1e-12);  // in the wall
  EXPECT_NEAR(shell.nearest({0.5, 0.5, 3}).distance_m, 2, 1e-12);
  EXPECT_EQ(shell.depth_m({0.5, 0.5, 0.5}), 0);
}

TEST(MeshDistance, MovedToOtherVerticesIsTheDistanceToThatMesh) {
  TriangleMesh mesh = together(cube({0, 0, 0}, 1), cube({0.8, 0.1, 0.1}, 1));
  const MeshDistance before{mesh};
  for (Vector3d& p : mesh.vertices) p = Vector3d{1.5 * p.x() + 0.2 * p.y() * p.y(), 0.7 * p.y(), p.z() - 0.3 * p.x()};
  const MeshDistance moved = before.movedTo(mesh.vertices), anew{mesh};
  std::mt19937 random{2};
  std::uniform_real_distribution<double> at{-1, 3};
  for (int i = 0; i < 500; ++i) {
    const Vector3d p{at(random), at(random), at(random)};
    EXPECT_NEAR(moved.nearest(p).distance_m, anew.nearest(p).distance_m, 1e-12);
    EXPECT_LE(moved.distanceAtLeast_m(p), moved.nearest(p).distance_m + 1e-12);
    EXPECT_EQ(moved.distanceAtLeast_m(p) < 0, moved.nearest(p).distance_m < 0);
  }
}

}  // namespace
}  // namespace sinew
