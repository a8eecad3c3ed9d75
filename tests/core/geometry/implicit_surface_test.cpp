#include "core/geometry/implicit_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace sinew {
namespace {

using Eigen::Vector3d;

SurfacePart part(std::unique_ptr<Primitive> primitive, JoinKind join = JoinKind::Add, double blend_m = 0) {
  return {join, blend_m, std::move(primitive)};
}
ImplicitSurface alone(std::unique_ptr<Primitive> primitive) {
  std::vector<SurfacePart> parts;
  parts.push_back(part(std::move(primitive)));
  return ImplicitSurface{std::move(parts)};
}
const Eigen::Matrix3d kAxes = Eigen::Matrix3d::Identity();
constexpr double kExact = 1e-12;

TEST(ImplicitSurface, SphereAndBoxAreExact) {
  const auto sphere = makeSphere({0.1, 0, 0}, 0.024);
  EXPECT_NEAR(sphere->distance({0.2, 0, 0}), 0.076, kExact);
  EXPECT_NEAR(sphere->distance({0.1, 0.012, 0}), -0.012, kExact);
  const auto box = makeBox(Vector3d::Zero(), {0.03, 0.02, 0.01}, kAxes, 0.005);
  EXPECT_NEAR(box->distance({0.05, 0, 0}), 0.02, kExact);
  EXPECT_NEAR(box->distance({0, 0, 0.004}), -0.006, kExact);
  // The rounded corner lies r (sqrt 3 - 1) inside the sharp one.
  EXPECT_NEAR(box->distance({0.03, 0.02, 0.01}), 0.005 * (std::sqrt(3.0) - 1), kExact);
}

TEST(ImplicitSurface, EllipsoidVanishesOnItsSurfaceAndHasTheRightSign) {
  const Vector3d radii{0.03, 0.01, 0.02};
  const Eigen::Matrix3d axes = axesFrom({1, 1, 0}, {-1, 1, 0.3});
  const auto ellipsoid = makeEllipsoid({0.01, 0.02, 0.03}, radii, axes);
  std::mt19937 random{3};
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    const Vector3d unit = Vector3d{normal(random), normal(random), normal(random)}.normalized();
    const Vector3d offset = axes * radii.cwiseProduct(unit);
    EXPECT_NEAR(ellipsoid->distance(Vector3d{0.01, 0.02, 0.03} + offset), 0, kExact);
    EXPECT_GT(ellipsoid->distance(Vector3d{0.01, 0.02, 0.03} + 1.05 * offset), 0);
    EXPECT_LT(ellipsoid->distance(Vector3d{0.01, 0.02, 0.03} + 0.95 * offset), 0);
  }
}

TEST(ImplicitSurface, StraightTubeIsACapsuleAndTapers) {
  const auto capsule = makeTube({{{0, 0, 0}, 0.01, 0.01}, {{0, 0.1, 0}, 0.01, 0.01}});
  EXPECT_NEAR(capsule->distance({0.03, 0.05, 0}), 0.02, kExact);
  EXPECT_NEAR(capsule->distance({0, -0.03, 0}), 0.02, kExact);
  const auto taper = makeTube({{{0, 0, 0}, 0.02, 0.01}, {{0, 0.1, 0}, 0.01, 0.005}});
  EXPECT_NEAR(taper->distance({0, 0.05, 0.015}), 0, kExact);  // u is z by default
  EXPECT_NEAR(taper->distance({0.0075, 0.05, 0}), 0, kExact);
}

TEST(ImplicitSurface, TubeFollowsItsSplineThroughEveryStation) {
  const std::vector<TubeStation> arc{
      {{0, 0, 0}, 0.005, 0.005}, {{0.03, 0.05, 0}, 0.006, 0.006}, {{0, 0.10, 0.02}, 0.004, 0.004}};
  const auto tube = makeTube(arc);
  for (const auto& s : arc) EXPECT_NEAR(tube->distance(s.center), -s.u_radius_m, 1e-9);
}

TEST(ImplicitSurface, SheetHasItsThickness) {
  const auto sheet =
      makeSheet({{{{0, 0, 0}, 0.002}, {{0.1, 0, 0}, 0.002}}, {{{0, 0.1, 0}, 0.004}, {{0.1, 0.1, 0}, 0.004}}});
  EXPECT_NEAR(sheet->distance({0.05, 0, 0.01}), 0.008, kExact);
  EXPECT_NEAR(sheet->distance({0.05, 0.05, 0.0}), -0.003, kExact);
  EXPECT_NEAR(sheet->distance({0.05, 0.13, 0.0}), 0.026, kExact);  // round edge
}

TEST(ImplicitSurface, DrumHasFlatEndsAndAWaist) {
  const auto drum = makeDrum(Vector3d::Zero(), {0.017, 0.014, 0.024}, kAxes, 0.002, 0.1);
  EXPECT_NEAR(drum->distance({0, 0.014, 0}), 0, kExact);
  EXPECT_NEAR(drum->distance({0, 0.020, 0}), 0.006, kExact);
  EXPECT_NEAR(drum->distance({0.015 * 0.9 + 0.002, 0, 0}), 0, kExact);
  EXPECT_NEAR(drum->distance({0, 0, 0.022 * 0.9 + 0.002}), 0, kExact);
}

TEST(ImplicitSurface, SmoothUnionAddsAFilletAndCutRemoves) {
  std::vector<SurfacePart> parts;
  parts.push_back(part(makeSphere({-0.01, 0, 0}, 0.01)));
  parts.push_back(part(makeSphere({0.01, 0, 0}, 0.01), JoinKind::Add, 0.004));
  const ImplicitSurface blended{parts};
  EXPECT_NEAR(blended.distance({0, 0, 0}), -0.001, kExact);  // k / 4 deep where the spheres touch
  EXPECT_NEAR(blended.distance({0.02, 0, 0}), 0, kExact);    // and untouched far from the joint
  parts.push_back(part(makeSphere({0.01, 0, 0}, 0.006), JoinKind::Cut));
  EXPECT_NEAR(ImplicitSurface{parts}.distance({0.01, 0, 0}), 0.006, kExact);
  parts.back() = part(makeSphere({0.01, 0, 0}, 0.006), JoinKind::Keep);
  EXPECT_GT(ImplicitSurface{parts}.distance({-0.01, 0, 0}), 0);
  EXPECT_NEAR(ImplicitSurface{parts}.distance({0.01, 0, 0}), -0.006, kExact);
}

TEST(ImplicitSurface, SymmetricSurfacesMirror) {
  std::vector<SurfacePart> parts;
  parts.push_back(part(makeSphere({0, 0, 0.03}, 0.01)));
  const ImplicitSurface pair{parts, true};
  EXPECT_NEAR(pair.distance({0, 0, -0.03}), -0.01, kExact);
  EXPECT_NEAR(pair.lower().z(), -pair.upper().z(), kExact);
}

TEST(ImplicitSurface, NearestPointAndGradient) {
  const ImplicitSurface ellipsoid = alone(makeEllipsoid(Vector3d::Zero(), {0.03, 0.02, 0.01}, kAxes));
  const Vector3d p = ellipsoid.nearestSurfacePoint({0.02, 0.02, 0.01});
  EXPECT_LT(std::abs(ellipsoid.distance(p)), 1e-6);
  EXPECT_NEAR(ellipsoid.gradient({0.03, 0, 0}).x(), 1, 1e-3);  // central differences over 20 um
}

TEST(ImplicitSurface, FirstPartMustBeAdded) {
  std::vector<SurfacePart> parts;
  parts.push_back(part(makeSphere({0, 0, 0}, 0.01), JoinKind::Cut));
  EXPECT_THROW(ImplicitSurface{parts}, std::logic_error);
}

}  // namespace
}  // namespace sinew
