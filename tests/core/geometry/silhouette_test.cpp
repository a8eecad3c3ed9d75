#include "core/geometry/silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/bone_contours.h"
#include "tests/support/shapes.h"

namespace sinew {
namespace {

constexpr double kRadius_m = 0.05;
// A chord of the 96-gon leaves the circle by 1 - cos(pi/96) = 0.05 %.
constexpr double kFacet = 0.001;

View frontal(std::variant<ConeBeam, SlotScan, Orthographic> projection, double distance_m) {
  View view;
  view.projection = projection;
  view.R_CW << 0, 0, 1, 0, -1, 0, 1, 0, 0;  // u = patient's Z, v down, depth = X
  view.p_CW = {0, 0, distance_m};
  view.width_px = view.height_px = 1000;
  return view;
}

struct Extent {
  double u_px = 0, v_px = 0;
};
Extent halfExtent(const ImageLine& line) {
  Eigen::Vector2d lo = line.front(), hi = line.front();
  for (const auto& p : line) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  return {(hi.x() - lo.x()) / 2, (hi.y() - lo.y()) / 2};
}

TEST(Silhouette, SphereInAConeBeamIsTheTangentCone) {
  const double f_px = 2000, distance_m = 0.6;
  const View view = frontal(ConeBeam{f_px, f_px, 500, 500}, distance_m);
  const auto lines =
      silhouette(test::ellipsoid(Eigen::Vector3d::Constant(kRadius_m)), RigidTransform::Identity(), view);

  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  // Not f R / d: the rays touch the sphere before its equator.
  const double radius_px = f_px * std::tan(std::asin(kRadius_m / distance_m));
  for (const auto& p : lines[0]) EXPECT_NEAR((p - Eigen::Vector2d{500, 500}).norm(), radius_px, kFacet * radius_px);
}

TEST(Silhouette, SlotScanMagnifiesAcrossTheSlotOnly) {
  const double source_m = 0.9, spacing_m = 0.0002;
  const View view = frontal(SlotScan{source_m, spacing_m, spacing_m, 500, 500}, 0);
  const auto lines =
      silhouette(test::ellipsoid(Eigen::Vector3d::Constant(kRadius_m)), RigidTransform::Identity(), view);

  ASSERT_EQ(lines.size(), 1u);
  const double u_px = source_m * std::tan(std::asin(kRadius_m / source_m)) / spacing_m;
  EXPECT_NEAR(halfExtent(lines[0]).u_px, u_px, kFacet * u_px);
  EXPECT_NEAR(halfExtent(lines[0]).v_px, kRadius_m / spacing_m, kFacet * kRadius_m / spacing_m);
}

TEST(Silhouette, RaysSeeThroughSoThatHiddenContoursAreDrawn) {
  const double spacing_m = 0.0005, ring_m = 0.05, tube_m = 0.01;
  const View view = frontal(Orthographic{spacing_m, spacing_m, 500, 500}, 0);
  // The ring seen along its own axis, a little oblique: outer and inner rim.
  RigidTransform X_WB = RigidTransform::Identity();
  X_WB.linear() = rotationAbout<double>({0, 0, 1}, M_PI / 2);
  auto lines = silhouette(test::torus(ring_m, tube_m), X_WB, view);

  ASSERT_EQ(lines.size(), 2u);
  std::ranges::sort(lines, {}, &lengthOf);
  EXPECT_NEAR(lengthOf(lines[0]), 2 * M_PI * (ring_m - tube_m) / spacing_m, 1);  // px
  EXPECT_NEAR(lengthOf(lines[1]), 2 * M_PI * (ring_m + tube_m) / spacing_m, 1);
}

TEST(Silhouette, FollowsThePoseAndDropsSpecks) {
  const View view = frontal(Orthographic{0.001, 0.001, 500, 500}, 0);
  RigidTransform X_WB = RigidTransform::Identity();
  X_WB.translation() = Eigen::Vector3d{0.3, 0.1, -0.2};
  const auto sphere = test::ellipsoid(Eigen::Vector3d::Constant(kRadius_m));
  const auto lines = silhouette(sphere, X_WB, view);
  ASSERT_EQ(lines.size(), 1u);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& p : lines[0]) sum += p;
  EXPECT_LT((sum / lines[0].size() - Eigen::Vector2d(300, 400)).norm(), 1) << sum.transpose() / lines[0].size();
  EXPECT_TRUE(silhouette(sphere, X_WB, view, 1000).empty());
}

TEST(Silhouette, NothingBehindTheSource) {
  const View view = frontal(ConeBeam{2000, 2000, 500, 500}, -0.6);
  EXPECT_TRUE(
      silhouette(test::ellipsoid(Eigen::Vector3d::Constant(kRadius_m)), RigidTransform::Identity(), view).empty());
}

TEST(Silhouette, RayDirectionIsThatOfTheRayThroughThePixel) {
  for (const View& view :
       {frontal(ConeBeam{2000, 1900, 480, 510}, 1.2), frontal(SlotScan{0.9, 2e-4, 2e-4, 500, 500}, 0),
        frontal(Orthographic{2e-4, 2e-4, 500, 500}, 0)}) {
    const Eigen::Vector3d p_W{0.03, 0.02, -0.04};
    const auto uv_px = project(view, p_W);
    ASSERT_TRUE(uv_px);
    EXPECT_LT((rayDirectionAt(view, p_W) - backProject(view, *uv_px).direction_W).norm(), 1e-9);
  }
}

TEST(BoneContours, KeepTheNamesAndLeaveOutWhatTheImageDoesNotShow) {
  const View view = frontal(Orthographic{0.001, 0.001, 500, 500}, 0);
  const auto ball = test::ellipsoid(Eigen::Vector3d::Constant(kRadius_m));
  std::vector<RigidTransform> X_WB(2, RigidTransform::Identity());
  X_WB[1].translation().z() = 5;  // far to the side
  const auto contours = boneContours({{"femur_r", 0, ball}, {"hand_r", 1, ball}}, X_WB, view);
  ASSERT_EQ(contours.size(), 1u);
  EXPECT_EQ(contours[0].bone, "femur_r");
  EXPECT_THROW(boneContours({{"femur_r", 2, ball}}, X_WB, view), std::logic_error);
}

}  // namespace
}  // namespace sinew
