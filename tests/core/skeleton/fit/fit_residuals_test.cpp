#include "core/skeleton/fit/fit_residuals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/skeleton/fit/fit_start_internal.h"
#include "core/skeleton/shape/population.h"
#include "tests/support/resources.h"
#include "tests/support/synthetic_views.h"

namespace sinew {
namespace {

class FitResiduals : public testing::Test {
 protected:
  FitResiduals() {
    for (const char* name : {"asis_r", "femoral_neck_base_l", "medial_malleolus_r", "metatarsal_5_head_l"})
      landmarks.push_back(skeleton.landmarkIndex(name));
    std::normal_distribution<double> normal;
    for (double& entry : z) entry = 0.7 * normal(random);
    for (int i = 0; i < body.count(); ++i) all.push_back(i);
  }

  Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  std::vector<ShapePrior> priors = loadShapePriors(test::resourceDir());
  BodyParameters body{skeleton, priors};
  std::mt19937_64 random{3};
  Eigen::VectorXd z = Eigen::VectorXd::Zero(body.count());
  std::vector<int> landmarks, all;
  std::vector<View> views = test::coneBeamPair();

  /// A model of one exposure and exact views.
  FitModel modelOf(const std::vector<FitView>& fit_views, const Nuisances& nuisances) const {
    return {skeleton, body, fit_views, nuisances, landmarks, {0, 0.9, 0}};
  }
};

TEST_F(FitResiduals, TheMeanBodyHasTheMeanShape) {
  std::vector<double> shape, q, zero(static_cast<std::size_t>(body.count()), 0.0);
  body.expand<double>(zero, shape, q);
  const auto& names = shapeParameterNames();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto prior = std::ranges::find(priors, names[i], &ShapePrior::parameter);
    EXPECT_NEAR(shape[i], prior->mean * (isShapeAngle(names[i]) ? 1 : body.meanSize()), 1e-12) << names[i];
  }
  for (const double entry : q) EXPECT_EQ(entry, 0);
}

TEST_F(FitResiduals, OneDeviationIsOneSdOfItsParameterAndSizeMovesAllRatios) {
  std::vector<double> shape, q, deviations(static_cast<std::size_t>(body.count()), 0.0);
  const auto index = [](const std::string& name) {
    const auto& names = shapeParameterNames();
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  deviations[1 + index("tibia_l.torsion")] = 2;  // mean 3, SD 8 deg
  deviations[BodyParameters::kSize] = 1;         // 0.90 + 0.15
  body.expand<double>(deviations, shape, q);
  EXPECT_NEAR(shape[index("tibia_l.torsion")], 19 * std::numbers::pi / 180, 1e-12);
  EXPECT_NEAR(shape[index("femur_r.elongation")], 1.05, 1e-12);
  EXPECT_NEAR(shape[index("hand_l.scale")], 1.05, 1e-12);
}

TEST_F(FitResiduals, AutomaticDerivativesOfPointsAgreeWithDifferences) {
  const PosedPoints points = posePoints(skeleton, body, landmarks, z, all);
  constexpr double kStep = 1e-5;
  for (const int i : all) {
    Eigen::VectorXd ahead = z, behind = z;
    ahead[i] += kStep;
    behind[i] -= kStep;
    const auto a = posePoints(skeleton, body, landmarks, ahead, {}).p_W;
    const auto b = posePoints(skeleton, body, landmarks, behind, {}).p_W;
    for (std::size_t l = 0; l < landmarks.size(); ++l)
      EXPECT_LT((points.dp_dz[l].col(i) - (a[l] - b[l]) / (2 * kStep)).norm(), 1e-8) << "entry " << i;
  }
}

TEST_F(FitResiduals, ResidualsAreObservedMinusProjectedInSigmas) {
  const Orthographic film{.column_spacing_m = 0.001, .row_spacing_m = 0.001, .u0_px = 100, .v0_px = 200};
  const std::vector<FitView> films = exactViews(std::vector<View>{View{.projection = film}});
  const Nuisances none{skeleton, body, films, {}, all};
  const FitModel model = modelOf(films, none);
  SharedBody shared{model, all, z, {}, false};
  shared.PrepareForEvaluation(false, true);
  const Eigen::Vector3d p_W = shared.points(0).p_W[1];
  const Eigen::Vector2d uv{100 + 1000 * p_W.x() + 6, 200 + 1000 * p_W.y() - 3};
  const LandmarkCost cost{shared, 1, {{0, uv}}, 9 * Eigen::Matrix2d::Identity()};
  const double* x[] = {shared.x()};
  double residual[2];
  ASSERT_TRUE(cost.Evaluate(x, residual, nullptr));
  EXPECT_NEAR(residual[0], 2, 1e-9);
  EXPECT_NEAR(residual[1], -1, 1e-9);
}

TEST_F(FitResiduals, WhatAllSightingsHaveInCommonCountsOnce) {
  // Both views miss the point by the same 6 px for one reason: one sigma, not two.
  const Orthographic film{.column_spacing_m = 0.001, .row_spacing_m = 0.001};
  const std::vector<FitView> films = exactViews(std::vector<View>(2, View{.projection = film}));
  const Nuisances none{skeleton, body, films, {}, all};
  const FitModel model = modelOf(films, none);
  SharedBody shared{model, all, z, {}, false};
  shared.PrepareForEvaluation(false, true);
  const Eigen::Vector3d p_W = shared.points(0).p_W[1];
  const Eigen::Vector2d uv{1000 * p_W.x() + 6, 1000 * p_W.y()};
  Eigen::Matrix4d covariance = 1e-6 * Eigen::Matrix4d::Identity();
  for (const int i : {0, 1})
    for (const int k : {0, 1})
      for (const int c : {0, 1}) covariance(2 * i + c, 2 * k + c) += 36;
  const LandmarkCost cost{shared, 1, {{0, uv}, {1, uv}}, covariance};
  const double* x[] = {shared.x()};
  Eigen::Vector4d residual;
  ASSERT_TRUE(cost.Evaluate(x, residual.data(), nullptr));
  EXPECT_NEAR(residual.norm(), 1, 1e-6);
}

TEST_F(FitResiduals, GradientsAgreeWithDifferences) {
  // Every kind of unknown: body, movement of body and joints before the second view, errors of the geometry.
  std::vector<FitView> fit_views = exactViews(views);
  std::get<ConeBeam>(fit_views[1].view.projection).k1 = 0.05;
  fit_views[1].exposure = 1;
  fit_views[1].uncertainty = {0.01, 3, 0.02, 0.02, 0.03, 0.05};
  const Nuisances nuisances{skeleton, body, fit_views, {}, all};
  EXPECT_EQ(nuisances.count(), 6 + 14 + 1 + kViewErrors);
  const FitModel model = modelOf(fit_views, nuisances);
  Eigen::VectorXd y(nuisances.count());
  for (int i = 0; i < y.size(); ++i) y[i] = std::sin(1.0 + i);
  SharedBody shared{model, all, z, y, true};
  const LandmarkCost cost{shared, 2, {{0, {1400, 3000}}, {1, {1400, 3000}}}, 4 * Eigen::Matrix4d::Identity()};
  const double* x[] = {shared.x()};
  const auto size = static_cast<std::size_t>(shared.size());
  std::vector<double> jacobian(4 * size);
  double residual[4], *jacobians[] = {jacobian.data()};
  shared.PrepareForEvaluation(true, true);
  ASSERT_TRUE(cost.Evaluate(x, residual, jacobians));
  constexpr double kStep = 1e-5;
  for (std::size_t i = 0; i < size; ++i) {
    double ahead[4], behind[4];
    shared.x()[i] += kStep;
    shared.PrepareForEvaluation(false, true);
    cost.Evaluate(x, ahead, nullptr);
    shared.x()[i] -= 2 * kStep;
    shared.PrepareForEvaluation(false, true);
    cost.Evaluate(x, behind, nullptr);
    shared.x()[i] += kStep;
    for (std::size_t r = 0; r < 4; ++r)
      EXPECT_NEAR(jacobian[r * size + i], (ahead[r] - behind[r]) / (2 * kStep), 1e-3)
          << i;  // of some hundred sigma per SD
  }
}

TEST_F(FitResiduals, APointBehindTheSourceRefusesTheStep) {
  test::placeView(views[0], -Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY(), {-5, 0.5, 0});  // looks away
  const std::vector<FitView> fit_views = exactViews(views);
  const Nuisances none{skeleton, body, fit_views, {}, all};
  const FitModel model = modelOf(fit_views, none);
  SharedBody shared{model, all, z, {}, false};
  shared.PrepareForEvaluation(false, true);
  const LandmarkCost cost{shared, 0, {{0, {0, 0}}}, Eigen::Matrix2d::Identity()};
  const double* x[] = {shared.x()};
  double residual[2];
  EXPECT_FALSE(cost.Evaluate(x, residual, nullptr));
}

TEST_F(FitResiduals, PriorResidualIsTheWeightedDeviation) {
  const PriorCost cost{{1, 0.5}};
  const double values[] = {3, -4}, *x[] = {values};
  double residual[2], jacobian[4], *jacobians[] = {jacobian};
  ASSERT_TRUE(cost.Evaluate(x, residual, jacobians));
  EXPECT_EQ(residual[0], 3);
  EXPECT_EQ(residual[1], -2);
  EXPECT_EQ(std::vector<double>(jacobian, jacobian + 4), (std::vector<double>{1, 0, 0, 0.5}));
}

TEST_F(FitResiduals, ThePriorKnowsNothingOfWhereThePatientStands) {
  for (int i = 0; i < 6; ++i) EXPECT_LE(body.priorWeight(body.postureBegin() + i), 0.01);
  EXPECT_EQ(body.priorWeight(body.postureBegin() + 6), 1);
  EXPECT_THROW((BodyParameters{skeleton, std::vector<ShapePrior>{{"femur.size", 1, 0.1, ""}}}), InputError);
  EXPECT_THROW((BodyParameters{skeleton, std::vector<ShapePrior>{{"foot_r.scale", 1, 0, ""}}}), InputError);
}

class StartOfFit : public testing::Test {
 protected:
  StartOfFit() {
    std::uniform_real_distribution<double> place{-0.4, 0.4};
    for (int i = 0; i < 12; ++i) body.emplace_back(place(random), place(random) + 0.55, place(random));
    truth.R = rotationFromVector<double>(Eigen::Vector3d{0.4, -2.2, 0.3});
    truth.t = Eigen::Vector3d{0, 0.55, 0} - truth.scale * truth.R * Eigen::Vector3d{0, 0.55, 0};
  }
  Eigen::Vector3d moved(const Eigen::Vector3d& p) const { return truth.scale * truth.R * p + truth.t; }
  static double angleTo(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    return vectorFromRotation(a.transpose() * b).norm();
  }

  std::mt19937_64 random{2};
  std::vector<Eigen::Vector3d> body;
  Similarity truth{0.6, {}, {}};
};

TEST_F(StartOfFit, AlignmentIgnoresAFewGrossErrors) {
  std::vector<Eigen::Vector3d> world;
  for (const auto& p : body) world.push_back(moved(p));
  world[3] += Eigen::Vector3d{0.5, 0, 0};
  world[8] += Eigen::Vector3d{0, -0.3, 0.3};
  const auto found = alignPoints(body, world);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->scale, truth.scale, 1e-3);
  EXPECT_LT(angleTo(found->R, truth.R), 1e-3);
  EXPECT_FALSE(alignPoints(std::span{body}.first(2), std::span{world}.first(2)));
}

TEST_F(StartOfFit, TwoViewsGiveTheExactPlace) {
  const auto views = test::slotScanPair();
  std::vector<StartSighting> sightings;
  for (int i = 0; i < 12; ++i)
    for (int v = 0; v < 2; ++v) sightings.push_back({i, v, *project(views[v], moved(body[i])), 1});
  const Similarity found = startOfFit(body, views, sightings, 1);
  EXPECT_NEAR(found.scale, truth.scale, 1e-9);
  EXPECT_LT((found.t - truth.t).norm(), 1e-9);
}

TEST_F(StartOfFit, OneViewIsSearchedFromAllSides) {
  const auto views = test::coneBeamPair();
  truth.scale = 1;
  truth.R = rotationFromVector<double>(Eigen::Vector3d{0.1, 1.5, -0.1});
  truth.t = Eigen::Vector3d{0, 0.55, 0} - truth.R * Eigen::Vector3d{0, 0.55, 0};
  std::vector<StartSighting> sightings;
  for (int i = 0; i < 12; ++i) sightings.push_back({i, 0, *project(views[0], moved(body[i])), 1});
  const Similarity found = startOfFit(body, std::span{views}.first(1), sightings, 1);
  EXPECT_LT(angleTo(found.R, truth.R), 0.5);  // 45 deg grid: near enough for the fit
  EXPECT_LT((found.R * body[0] + found.t - moved(body[0])).norm(), 0.3);
}

}  // namespace
}  // namespace sinew
