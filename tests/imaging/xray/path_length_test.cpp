#include "imaging/xray/path_length.h"

#include <gtest/gtest.h>

#include "tests/support/solids.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr int kWidth = 160, kHeight = 120;

/// Views along world -X, as a frontal radiograph: u to the patient's left, v down. Millimetre pixels at the origin.
View frontalView(std::variant<ConeBeam, SlotScan, Orthographic> projection) {
  View view{projection, {}, {}, kWidth, kHeight};
  view.R_CW << 0, 0, -1, 0, -1, 0, -1, 0, 0;
  view.p_CW = std::holds_alternative<ConeBeam>(projection) ? Vector3d{0, 0, 1} : Vector3d::Zero();
  return view;
}
View coneBeam() {
  return frontalView(ConeBeam{.fx_px = 1000, .fy_px = 1000, .cx_px = 80.3, .cy_px = 59.8});
}
View slotScan() {
  return frontalView(SlotScan{1.0, 0.001, 0.001, 80.3, 59.8});
}
View parallel() {
  return frontalView(Orthographic{0.001, 0.001, 80.3, 59.8});
}
std::vector<View> allViews() {
  return {coneBeam(), slotScan(), parallel()};
}

double chord_m(const Ray& ray, const Vector3d& center, double radius_m) {
  const double miss2 = (center - ray.origin_W).cross(ray.direction_W).squaredNorm();
  return miss2 < radius_m * radius_m ? 2 * std::sqrt(radius_m * radius_m - miss2) : 0;
}

/// Length of a ray in a box with edges along the axes: the slabs' intersection.
double boxPath_m(const Ray& ray, const Vector3d& low, const Vector3d& high) {
  double enter = -1e9, leave = 1e9;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(ray.direction_W[k]) < 1e-12) {
      if (ray.origin_W[k] < low[k] || ray.origin_W[k] > high[k]) return 0;
      continue;
    }
    const double a = (low[k] - ray.origin_W[k]) / ray.direction_W[k],
                 b = (high[k] - ray.origin_W[k]) / ray.direction_W[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return std::max(0.0, leave - enter);
}

TEST(AttenuationField, OfABallIsTheChord) {
  const Vector3d center{0.05, 0.012, -0.02};
  constexpr double kRadius_m = 0.03;
  // 180 rings: the facets lie at most r (pi / 180)^2 / 8 = 1.2 um below the sphere. Near the outline, where the chord
  // falls like a square root, that is sqrt(2 r 1.2 um) = 0.3 mm.
  const auto mesh = test::ballMesh(center, kRadius_m, 180);
  for (const View& view : allViews()) {
    const auto field = attenuationField({{mesh, 20.0}}, {}, view);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const double expected = chord_m(backProject(view, {u, v}), center, kRadius_m);
        const double tolerance_m = expected > 0.015 ? 2e-5 : 7e-4;
        ASSERT_NEAR(field[v * kWidth + u] / 20.0, expected, tolerance_m)
            << projectionName(view) << " at " << u << ", " << v;
      }
  }
}

TEST(AttenuationField, OfABoxIsTheSlabLengthAlsoOnItsEdges) {
  const Vector3d low{-0.02, -0.025, -0.03}, high{0.03, 0.02, 0.035};
  for (const View& view : allViews()) {
    const auto field = attenuationField({{test::boxMesh(low, high), 1.0}}, {}, view);
    int inside = 0;
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const Ray ray = backProject(view, {u, v});
        const double expected = boxPath_m(ray, low, high);
        // A straight edge is a hyperbola in a slot scan: up to 0.7 px beside the two-triangle face's border.
        const bool near_border =
            boxPath_m(ray, low - Vector3d::Constant(1e-3), high + Vector3d::Constant(1e-3)) > 0 &&
            boxPath_m(ray, low + Vector3d::Constant(3e-3), high - Vector3d::Constant(3e-3)) < 0.04;
        if (near_border) continue;
        inside += expected > 0;
        ASSERT_NEAR(field[v * kWidth + u], expected, 2e-6) << projectionName(view) << " at " << u << ", " << v;
      }
    EXPECT_GT(inside, 1000);
  }
}

TEST(AttenuationField, IsZeroOutsideAndWhereAHollowBodyIsEmpty) {
  const auto outer = test::ballMesh(Vector3d::Zero(), 0.03, 24), inner = test::ballMesh(Vector3d::Zero(), 0.02, 24);
  const auto field = attenuationField({{outer, 50.0}, {inner, -50.0}}, {}, parallel());
  EXPECT_EQ(field[0], 0.0F);
  EXPECT_NEAR(field[60 * kWidth + 80], 50 * 0.02, 50 * 2e-4);  // two walls of 10 mm; facets of 24 rings
  // Entries and exits balance at every pixel: no streak anywhere outside the outline.
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      if (std::hypot(u - 80.3, v - 59.8) > 31) {
        ASSERT_EQ(field[v * kWidth + u], 0.0F) << u << ", " << v;
      }
}

TEST(AttenuationField, CenterOfASmallDenseBallIsWhereProjectSays) {
  const Vector3d center{0.04, 0.0213, -0.0317};
  for (const View& view : allViews())
    for (const bool meshed : {false, true}) {
      const auto field = meshed ? attenuationField({{test::ballMesh(center, 0.007, 30), 1000.0}}, {}, view)
                                : attenuationField({}, {{center, 0.007, 1000.0}}, view);
      Eigen::Vector2d sum{0, 0};
      double mass = 0;
      for (int v = 0; v < kHeight; ++v)
        for (int u = 0; u < kWidth; ++u) {
          sum += field[v * kWidth + u] * Eigen::Vector2d(u, v);
          mass += field[v * kWidth + u];
        }
      ASSERT_GT(mass, 0);
      EXPECT_LT((sum / mass - *project(view, center)).norm(), 0.05) << projectionName(view) << " meshed " << meshed;
    }
}

TEST(AttenuationField, BodiesAddUpAndDistortionMovesThemAsProjectSays) {
  View view = coneBeam();
  std::get<ConeBeam>(view.projection).k1 = -2.0;  // strong: an image intensifier
  const Vector3d center{0, 0.03, -0.045};
  const auto field = attenuationField({{test::ballMesh(center, 0.006, 40), 1.0}}, {{center, 0.006, 2.0}}, view);
  const auto uv = *project(view, center);
  EXPECT_NEAR(field[std::lround(uv.y()) * kWidth + std::lround(uv.x())], 3 * 0.012, 3e-4);
}

TEST(AttenuationField, StopsWhenAskedAndRefusesABodyAtTheSource) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(attenuationField({{test::boxMesh(Vector3d::Zero(), Vector3d::Ones()), 1.0}}, {}, parallel(),
                               {{}, stop.get_token()})
                  .empty());
  EXPECT_THROW(attenuationField({{test::ballMesh({1, 0, 0}, 0.1, 8), 1.0}}, {}, coneBeam()), std::logic_error);
}

}  // namespace
}  // namespace sinew
