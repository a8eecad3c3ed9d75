#include "core/skeleton/fit/triangulated_figures_internal.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/skeleton/fit/bone_figures_internal.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/shape/population.h"
#include "tests/support/resources.h"
#include "tests/support/synthetic_views.h"

namespace sinew {
namespace {

ImageOfPoint imageIn(const std::vector<View>& views) {
  return [&views](int, int view, const Eigen::Vector3d& p, SeenImage& seen) {
    using Jet = ceres::Jet<double, 3>;
    Eigen::Matrix<Jet, 2, 1> uv;
    if (!project<Jet>(views[std::size_t(view)], Vector3<Jet>{Jet(p.x(), 0), Jet(p.y(), 1), Jet(p.z(), 2)}, uv))
      return false;
    for (int i = 0; i < 2; ++i) seen.uv_px[i] = uv[i].a, seen.by_point.row(i) = uv[i].v;
    seen.by_nuisance.resize(2, 0);
    return true;
  };
}

LandmarkPicks picksOf(const std::vector<View>& views, const Eigen::Vector3d& p_W, double sigma_px) {
  LandmarkPicks picks;
  picks.uv_px.resize(2 * Eigen::Index(views.size()));
  picks.covariance_px2 = sigma_px * sigma_px * Eigen::MatrixXd::Identity(picks.uv_px.size(), picks.uv_px.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    picks.views.push_back(int(v));
    picks.uv_px.segment<2>(2 * Eigen::Index(v)) = *project(views[v], p_W);
  }
  return picks;
}

TEST(PickedPoint, IsWhereTheRaysMeetWithTheSpreadOfThePicks) {
  const auto views = test::coneBeamPair();
  const Eigen::Vector3d p_W{0.03, 0.6, -0.08};
  const LandmarkPicks exact = picksOf(views, p_W, 5.9);  // 1 mm in the plane of the body
  const auto point = pickedPoint(exact, imageIn(views), p_W + Eigen::Vector3d{0.05, -0.05, 0.05});
  ASSERT_TRUE(point);
  EXPECT_LT((point->p_W - p_W).norm(), 1e-9);
  EXPECT_NEAR(point->disagreement, 0, 1e-6);
  // Forward and sideways from one view each, height from both.
  EXPECT_NEAR(std::sqrt(point->covariance_W_m2(0, 0)), 1e-3, 1e-4);
  EXPECT_NEAR(std::sqrt(point->covariance_W_m2(2, 2)), 1e-3, 1e-4);
  EXPECT_NEAR(std::sqrt(point->covariance_W_m2(1, 1)), 1e-3 / std::sqrt(2), 1e-4);
}

TEST(PickedPoint, SaysWhenItsPicksDoNotMeetOrLeaveADirectionOpen) {
  const auto views = test::coneBeamPair();
  const Eigen::Vector3d p_W{0.03, 0.6, -0.08};
  LandmarkPicks picks = picksOf(views, p_W, 5.9);
  picks.uv_px[3] += 10 * 5.9 * std::sqrt(2);  // heights of the two views differ by 14 sigma: 10 of the difference's
  EXPECT_NEAR(pickedPoint(picks, imageIn(views), p_W)->disagreement, 10, 0.3);
  picks.views.resize(1);
  picks.uv_px.conservativeResize(2);
  picks.covariance_px2.conservativeResize(2, 2);
  EXPECT_FALSE(pickedPoint(picks, imageIn(views), p_W));
  const std::vector<View> twice = {views[0], views[0]};
  EXPECT_FALSE(pickedPoint(picksOf(twice, p_W, 5.9), imageIn(twice), p_W));
}

/// Figures of exact picks of the protocol's landmarks, by name.
std::pair<std::vector<BoneFigure>, TriangulatedFigures> figuresOf(const ShapeParameters& shape,
                                                                  const std::vector<std::string>& without = {}) {
  const Skeleton reference = loadReferenceSkeleton(test::resourceDir());
  const Skeleton body = deformedSkeleton(reference, shape);
  const Posture posture = zeroPosture(reference);
  const auto X_WB = segmentPoses(body, posture);
  std::vector<PickedPoint> points;
  for (const auto& wanted : loadLandmarkProtocol(test::resourceDir())) {
    if (std::ranges::count(without, wanted.name)) continue;
    const Landmark& landmark = body.landmark(wanted.name);
    PickedPoint point;
    point.landmark = body.landmarkIndex(wanted.name);
    point.p_W = X_WB[std::size_t(landmark.segment)] * landmark.p_BL;
    point.covariance_W_m2 = 1e-6 * Eigen::Matrix3d::Identity();
    points.push_back(point);
  }
  return {boneFigures(reference, shape, posture), triangulatedFigures(reference, points)};
}

TEST(TriangulatedFigures, AreTheTruthForExactPicksOfAnyBody) {
  std::mt19937_64 random{3};
  const auto priors = loadShapePriors(test::resourceDir());
  for (int body = 0; body < 3; ++body) {
    const auto [truth, picked] = figuresOf(drawShape(priors, random));
    for (std::size_t f = 0; f < truth.size(); ++f) {
      if (truth[f].quantity == "neck_shaft_angle") {
        EXPECT_TRUE(std::isnan(picked.value[f]));  // the protocol has no point of the shaft
        continue;
      }
      EXPECT_NEAR(picked.value[f], truth[f].value, 0.05) << truth[f].quantity << truth[f].side;  // mm and deg
      EXPECT_GT(picked.sd[f], 0) << truth[f].quantity;
    }
  }
}

TEST(TriangulatedFigures, HaveTheSpreadThatIndependentPointsGive) {
  const auto [truth, picked] = figuresOf({});
  // 1 mm in every direction at head, epicondyles and condyle centres: a length has sqrt(1 + 1/4) at least, since the
  // knee is no better than the mean of four points.
  EXPECT_GT(picked.sd[0], std::sqrt(1.25) - 0.01);
  EXPECT_LT(picked.sd[0], 1.5);
  const std::size_t width =
      std::size_t(std::ranges::find(truth, "pelvic_width", &BoneFigure::quantity) - truth.begin());
  EXPECT_NEAR(picked.sd[width], std::sqrt(2.0), 0.01);
}

TEST(TriangulatedFigures, ThatLackALandmarkAreNotGiven) {
  const auto [truth, picked] = figuresOf({}, {"femoral_head_center_r"});
  for (std::size_t f = 0; f < truth.size(); ++f) {
    const bool needs_head =
        (truth[f].side == "r" && truth[f].quantity != "tibia_length" && truth[f].quantity != "tibial_torsion") ||
        truth[f].side.empty() || truth[f].quantity == "neck_shaft_angle";
    EXPECT_EQ(std::isnan(picked.value[f]), needs_head) << truth[f].quantity << truth[f].side;
  }
}

}  // namespace
}  // namespace sinew
