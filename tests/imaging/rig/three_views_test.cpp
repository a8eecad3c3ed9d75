// More than two views: what a third one adds, and what it must not break.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "imaging/rig/triangulate.h"
#include "tests/imaging/rigs.h"

namespace sinew {
namespace {

using test::see;

const Eigen::Vector3d kKnee{0.03, -0.12, 0.09};
/// What the program that knew two views only gave for TwoOfThemGiveWhatThePairGave.
const Eigen::Vector3d kTwoViewPoint_m{0.029857920101256041, -0.12014046759309174, 0.089711995357924013};

std::vector<Sighting> seeIn(const BiplanarRig& rig, const std::vector<int>& views, const std::string& name = "L") {
  std::vector<Sighting> sightings;
  for (const int view : views) sightings.push_back(see(rig, view, kKnee, name));
  return sightings;
}

TEST(ThreeViews, InformationAddsUp) {
  // With the point fixed, the inverse covariance of all views is the sum of what single views know: pairs give
  // I_12 + I_13 + I_23 = 2 (I_1 + I_2 + I_3).
  const BiplanarRig rig = test::threeViews(40);
  const Eigen::Matrix3d all = triangulate(rig, seeIn(rig, {0, 1, 2}))->cov_W.inverse();
  Eigen::Matrix3d pairs = Eigen::Matrix3d::Zero();
  for (const auto& pair : {std::vector{0, 1}, {0, 2}, {1, 2}})
    pairs += triangulate(rig, seeIn(rig, pair))->cov_W.inverse();
  EXPECT_LT((all - pairs / 2).norm(), 1e-6 * all.norm());
}

TEST(ThreeViews, TheSameViewTwiceHalvesItsVariance) {
  // A repeated exposure of both views of an orthogonal pair: every variance is half as large.
  BiplanarRig rig = test::coneBeamRig();
  const Eigen::Matrix3d once = triangulate(rig, seeIn(rig, {0, 1}))->cov_W;
  rig.views.push_back(rig.views[0]);
  rig.views.push_back(rig.views[1]);
  const Eigen::Matrix3d twice = triangulate(rig, seeIn(rig, {0, 1, 2, 3}))->cov_W;
  EXPECT_LT((once / 2 - twice).norm(), 1e-9 * once.norm());
}

TEST(ThreeViews, StatedCovarianceIsThatOfRepeatedPicks) {
  const BiplanarRig rig = test::threeViews(40);
  std::mt19937 random{3};
  std::normal_distribution<double> normal;
  auto sightings = seeIn(rig, {0, 1, 2});
  sightings[2].sigma_px = 3;
  const Eigen::Matrix3d stated = triangulate(rig, sightings)->cov_W;
  constexpr int kDraws = 2000;
  Eigen::Matrix3d empirical = Eigen::Matrix3d::Zero();
  for (int draw = 0; draw < kDraws; ++draw) {
    auto noisy = sightings;
    for (auto& s : noisy) s.uv_px += s.sigma_px * Eigen::Vector2d{normal(random), normal(random)};
    const Eigen::Vector3d error = triangulate(rig, noisy)->p_WL - kKnee;
    empirical += error * error.transpose() / kDraws;
  }
  const Eigen::Matrix3d whitener = stated.llt().matrixL().toDenseMatrix().inverse();
  const Eigen::Matrix3d identity = whitener * empirical * whitener.transpose();
  EXPECT_LT((identity - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.15) << identity;  // 2000 draws: SD 3 %
}

TEST(ThreeViews, AnObliqueOneResolvesWhatTwoNearlyParallelOnesCannot) {
  BiplanarRig rig = test::threeViews(3);  // views 1 and 3 are 3 deg apart
  EXPECT_FALSE(triangulate(rig, seeIn(rig, {0, 2})));
  const auto point = triangulate(rig, seeIn(rig, {0, 2, 1}));
  ASSERT_TRUE(point);
  EXPECT_LT((point->p_WL - kKnee).norm(), 1e-10);

  rig = test::threeViews(7);  // just allowed: depth is seen 1 / sin(7 deg) times worse than across
  const Eigen::Vector3d depth_W = rig.views[0].R_CW.row(2);
  const auto depthSd_mm = [&](const std::vector<int>& views) {
    return 1000 * std::sqrt(depth_W.dot(triangulate(rig, seeIn(rig, views))->cov_W * depth_W));
  };
  EXPECT_GT(depthSd_mm({0, 2}), 8 * depthSd_mm({0, 1, 2}));
}

TEST(ThreeViews, TwoOfThemGiveWhatThePairGave) {
  const BiplanarRig pair = test::coneBeamRig(), three = test::threeViews(40);
  std::vector<Sighting> sightings{see(pair, 0, kKnee), see(pair, 1, kKnee)};
  sightings[0].uv_px += Eigen::Vector2d{1.5, -2};
  sightings[1].uv_px += Eigen::Vector2d{-0.5, 3};
  const auto a = triangulate(pair, sightings), b = triangulate(three, sightings);
  EXPECT_EQ(a->p_WL, b->p_WL);
  EXPECT_EQ(a->cov_W, b->cov_W);
  EXPECT_NEAR(a->p_WL.x(), kTwoViewPoint_m.x(), 1e-14);
  EXPECT_NEAR(a->p_WL.y(), kTwoViewPoint_m.y(), 1e-14);
  EXPECT_NEAR(a->p_WL.z(), kTwoViewPoint_m.z(), 1e-14);
}

TEST(ThreeViews, TheViewThatDisagreesIsNamed) {
  const BiplanarRig rig = test::threeViews(40);
  auto sightings = seeIn(rig, {0, 1, 2}, "knee");
  sightings[1].uv_px.y() += 60;
  const auto warnings = triangulateAll(rig, sightings).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, "gross_mismatch");
  EXPECT_THAT(warnings[0].message, testing::HasSubstr("the sighting in view 2 misses the others"));
}

TEST(ThreeViews, PicksOfTwoViewsExchangedAreNamed) {
  const BiplanarRig rig = test::threeViews(40);
  std::vector<Sighting> sightings;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d p{0.02 * i - 0.05, 0.15 * i - 0.3, 0.03 * (i % 3)};
    for (const int view : {0, 1, 2}) sightings.push_back(see(rig, view, p, "L" + std::to_string(i)));
  }
  EXPECT_THAT(triangulateAll(rig, sightings).warnings, testing::IsEmpty());
  for (auto& s : sightings)
    if (s.view != 0) s.view = 3 - s.view;
  const auto warnings = triangulateAll(rig, sightings).warnings;
  EXPECT_THAT(warnings, testing::Contains(testing::Field(&Warning::message,
                                                         testing::HasSubstr("view 2 and view 3 are exchanged"))));
}

TEST(ThreeViews, EveryPairHasItsLines) {
  const BiplanarRig rig = test::threeViews(40);
  for (const int from : {0, 1, 2})
    for (const int to : {0, 1, 2}) {
      if (from == to) continue;
      const auto line = epipolarLine(rig, from, see(rig, from, kKnee).uv_px, to);
      ASSERT_EQ(line.size(), 2u);
      const Eigen::Vector2d along = (line[1] - line[0]).normalized();
      const Eigen::Vector2d off = see(rig, to, kKnee).uv_px - line[0];
      EXPECT_LT(std::abs(along.x() * off.y() - along.y() * off.x()), 0.05) << from << to;
    }
}

TEST(ThreeViews, RefusesAViewThatTheRigDoesNotHave) {
  const BiplanarRig rig = test::threeViews(40);
  auto sightings = seeIn(rig, {0, 1});
  sightings[1].view = 3;
  EXPECT_THROW(triangulate(rig, sightings), InputError);
  EXPECT_THROW(triangulateAll(rig, sightings), InputError);
}

TEST(ThreeViews, DistortionIsKeptInFull) {
  BiplanarRig rig = test::threeViews(40);
  for (auto& view : rig.views) {
    auto& c = std::get<ConeBeam>(view.projection);
    c.k1 = 0.3, c.k2 = -0.4, c.p1 = 0.01, c.p2 = -0.02, c.k3 = 0.5;
  }
  const auto point = triangulate(rig, seeIn(rig, {0, 1, 2}));
  ASSERT_TRUE(point);
  EXPECT_LT((point->p_WL - kKnee).norm(), 1e-10);
  EXPECT_LT(point->reprojection_rms_px, 1e-7);
}

}  // namespace
}  // namespace sinew
