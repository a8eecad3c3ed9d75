#include "core/geometry/isosurface.h"

#include <gtest/gtest.h>

#include <numbers>

namespace sinew {
namespace {

using Eigen::Vector3d;

TEST(Isosurface, OfABallIsClosedFacesOutwardsAndHasItsVolume) {
  const Vector3d center{0.1, -0.2, 0.05};
  constexpr double kRadius_m = 0.05, kCell_m = 0.004;
  const auto mesh = isosurface([&](const Vector3d& p) { return (p - center).norm() - kRadius_m; },
                               center - Vector3d::Constant(0.06), center + Vector3d::Constant(0.06), kCell_m);
  EXPECT_TRUE(isWatertight(mesh));
  const double ball = 4.0 / 3 * std::numbers::pi * std::pow(kRadius_m, 3);
  EXPECT_NEAR(signedVolume_m3(mesh) / ball, 1, 0.01);
  for (const auto& p : mesh.vertices)
    EXPECT_NEAR((p - center).norm(), kRadius_m,
                kCell_m * kCell_m / (4 * kRadius_m) * 3);  // diagonals are sqrt 3 longer
}

TEST(Isosurface, IsClosedForAnyFieldAlsoOneThatReachesTheBox) {
  // Values of no geometric meaning, each sign pattern occurs; the box cuts through the solid.
  const auto wild = [](const Vector3d& p) {
    return std::sin(97 * p.x()) + std::sin(83 * p.y() + 1) + std::sin(71 * p.z());
  };
  const auto mesh = isosurface(wild, Vector3d::Zero(), Vector3d::Constant(0.3), 0.01);
  EXPECT_GT(mesh.triangles.size(), 1000U);
  EXPECT_TRUE(isWatertight(mesh));
  EXPECT_GT(signedVolume_m3(mesh), 0);
}

TEST(Isosurface, OfNothingIsEmpty) {
  EXPECT_TRUE(
      isosurface([](const Vector3d&) { return 1.0; }, Vector3d::Zero(), Vector3d::Ones(), 0.2).triangles.empty());
}

}  // namespace
}  // namespace sinew
