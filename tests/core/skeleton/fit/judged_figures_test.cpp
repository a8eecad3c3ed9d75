// What a fit says of its own figures: bones outside the model, figures from the picks, advice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/fit/outside_bones_internal.h"
#include "core/skeleton/shape/population.h"
#include "tests/support/resources.h"
#include "tests/support/synthetic_views.h"

namespace sinew {
namespace {

using testing::Contains;
using testing::EndsWith;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

class JudgedFigures : public testing::Test {
 protected:
  JudgedFigures() {
    for (const auto& landmark : loadLandmarkProtocol(test::resourceDir())) protocol.push_back(landmark.name);
    std::mt19937_64 drawn{21};
    std::vector<ShapePrior> healthy;
    for (const auto& prior : priors)
      if (!prior.deformity) healthy.push_back(prior);
    shape = drawShape(healthy, drawn);
    posture = drawStandingPosture(skeleton, drawn);
  }
  std::vector<LandmarkObservation> seen(const std::vector<std::string>& names, double noise_mm = 1) {
    std::mt19937_64 random{5};
    return test::observe(skeleton, shape, posture, views, names, noise_mm, random);
  }
  /// Moves the picks of a landmark in both views to where the point would be that lies off by `by_W`.
  void displace(std::vector<LandmarkObservation>& picks, const std::string& name, const Eigen::Vector3d& by_W) const {
    const Skeleton body = deformedSkeleton(skeleton, shape);
    const Landmark& l = body.landmark(name);
    const Eigen::Vector3d p_W = segmentPoses(body, posture)[std::size_t(l.segment)] * l.p_BL;
    for (auto& pick : picks)
      if (pick.landmark == name)
        pick.uv_px += *project(views[std::size_t(pick.view)], Eigen::Vector3d{p_W + by_W}) -
                      *project(views[std::size_t(pick.view)], p_W);
  }
  SkeletonFit fit(const std::vector<LandmarkObservation>& picks) const {
    FitOptions options;
    options.offered_landmarks = protocol;
    return fitSkeleton(skeleton, exactViews(views), picks, priors, options);
  }
  static const BoneFigure& figure(const SkeletonFit& fit, const std::string& quantity, const std::string& side = "") {
    return *std::ranges::find_if(fit.figures,
                                 [&](const auto& f) { return f.quantity == quantity && f.side == side; });
  }
  static const FigureAdvice& adviceOf(const SkeletonFit& fit, const std::string& quantity,
                                      const std::string& side = "") {
    const auto at =
        std::ranges::find_if(fit.advice, [&](const auto& a) { return a.quantity == quantity && a.side == side; });
    if (at == fit.advice.end()) throw std::runtime_error{"no advice for " + quantity};
    return *at;
  }
  double truth(const std::string& quantity, const std::string& side = "") const {
    for (const auto& f : boneFigures(skeleton, shape, posture))
      if (f.quantity == quantity && f.side == side) return f.value;
    throw std::runtime_error{quantity};
  }

  Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  std::vector<ShapePrior> priors = loadShapePriors(test::resourceDir());
  std::vector<View> views = test::coneBeamPair();
  std::vector<std::string> protocol;
  ShapeParameters shape;
  Posture posture;
};

TEST_F(JudgedFigures, ABodyOfTheModelIsFittedWithTheTriangulatedFigureBesideIt) {
  const SkeletonFit result = fit(seen(protocol));
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_TRUE(result.outside.empty());
  for (const auto& f : result.figures) {
    EXPECT_TRUE(f.determined) << f.quantity;
    EXPECT_FALSE(f.triangulated) << f.quantity;
    if (f.quantity == "neck_shaft_angle") continue;  // needs points of the shaft
    EXPECT_LT(f.other_lower95, f.value) << f.quantity;
    EXPECT_GT(f.other_upper95, f.value) << f.quantity;
    EXPECT_GT(f.other_upper95 - f.other_lower95, f.upper95 - f.lower95 - 1e-9) << f.quantity;  // nothing is smoothed
  }
}

TEST_F(JudgedFigures, ABoneOutsideTheModelIsNamedAndItsFiguresAreThoseOfThePicks) {
  auto picks = seen(protocol);
  // A pelvis whose right half is small, which no parameter makes: hip and sacrum stay.
  for (const char* name : {"asis_r", "iliac_crest_r", "psis_r"}) displace(picks, name, {0, -0.015, -0.010});
  displace(picks, "pubic_symphysis_top", {0.012, 0, 0});
  const SkeletonFit result = fit(picks);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  ASSERT_FALSE(result.outside.empty());
  EXPECT_EQ(result.outside.front().segment, "pelvis");
  EXPECT_GT(result.outside.front().misfit, 2);
  EXPECT_GT(result.outside.front().distance_mm, 3);
  ASSERT_THAT(result.warnings, Contains(Field(&Warning::code, "outside_model")));
  const auto& said = *std::ranges::find(result.warnings, "outside_model", &Warning::code);
  EXPECT_THAT(said.message, HasSubstr("pelvis is outside the model"));
  EXPECT_THAT(said.message, HasSubstr(result.outside.front().landmark));
  for (const auto& warning : result.warnings) EXPECT_THAT(warning.message, Not(EndsWith("was left out")));

  const BoneFigure& tilt = figure(result, "pelvic_tilt");
  EXPECT_TRUE(tilt.triangulated);
  EXPECT_TRUE(tilt.determined);
  EXPECT_LT(tilt.lower95, truth("pelvic_tilt"));
  EXPECT_GT(tilt.upper95, truth("pelvic_tilt"));
  EXPECT_TRUE(std::isfinite(tilt.other));  // the fitted one is shown beside it
  EXPECT_THAT(result.warnings, Contains(Field(&Warning::code, "figures_triangulated")));
  EXPECT_FALSE(figure(result, "femur_length", "l").triangulated);  // legs are not concerned
}

TEST_F(JudgedFigures, OneSlipIsLeftOutButSeveralLandmarksOfABoneAreNot) {
  auto picks = seen(protocol);
  const auto slip = std::ranges::find(picks, "medial_epicondyle_l", &LandmarkObservation::landmark);
  slip->uv_px.x() += 150;  // along the epipolar line: the rays still meet, but the other view fits
  const auto leftOut = [](const SkeletonFit& result) {
    return std::ranges::count_if(result.warnings,
                                 [](const Warning& w) { return w.message.ends_with("was left out"); });
  };
  EXPECT_EQ(leftOut(fit(picks)), 1);
  picks = seen(protocol);
  for (const char* name : {"medial_malleolus_r", "lateral_malleolus_r", "tibial_plafond_center_r"})
    displace(picks, name, {0, 0.03, 0});
  displace(picks, "fibula_head_r", {-0.03, 0, 0.02});
  displace(picks, "tibial_tuberosity_r", {-0.03, 0, 0.02});
  const SkeletonFit result = fit(picks);
  EXPECT_EQ(leftOut(result), 0);
  EXPECT_THAT(result.outside, Contains(Field(&OutsideBone::segment, "tibia_r")));
}

TEST_F(JudgedFigures, AMisplacedJointCentreThatNoShapeFollowsIsTakenFromThePicks) {
  auto picks = seen(protocol);
  displace(picks, "sacral_endplate_center", {-0.02, 0, 0.015});  // its picks agree in both views
  const SkeletonFit result = fit(picks);
  const BoneFigure& tilt = figure(result, "pelvic_tilt");
  EXPECT_TRUE(tilt.triangulated);
  EXPECT_GT(tilt.value - tilt.other, 5);  // 20 mm over 100 mm
}

const std::vector<std::string> kCentres = {"femoral_head_center_r", "femoral_head_center_l", "knee_center_r",
                                           "knee_center_l",         "ankle_center_r",        "ankle_center_l"};

TEST_F(JudgedFigures, JointCentresAloneDetermineLengthsButNeitherTiltNorTorsion) {
  const SkeletonFit result = fit(seen(kCentres));
  ASSERT_EQ(result.outcome, Outcome::Converged);
  for (const char* side : {"r", "l"}) {
    EXPECT_TRUE(figure(result, "femur_length", side).determined);
    EXPECT_TRUE(figure(result, "tibia_length", side).determined);
    EXPECT_FALSE(figure(result, "femoral_torsion", side).determined);
    EXPECT_FALSE(figure(result, "tibial_torsion", side).determined);
    EXPECT_FALSE(figure(result, "neck_shaft_angle", side).determined);
  }
  EXPECT_TRUE(figure(result, "leg_length_difference").determined);
  EXPECT_TRUE(figure(result, "pelvic_obliquity").determined);
  EXPECT_FALSE(figure(result, "pelvic_tilt").determined);
  for (const auto& f : result.figures)
    for (const auto& limit : figureLimits())
      if (f.determined && f.quantity == limit.quantity) EXPECT_LE(f.upper95 - f.lower95, 2 * limit.half_width);
}

TEST_F(JudgedFigures, TheLandmarksThatAreAdvisedDoDetermineTheFigure) {
  const SkeletonFit before = fit(seen(kCentres));
  for (const auto& [quantity, side] : {std::pair{"pelvic_tilt", ""}, std::pair{"femoral_torsion", "r"},
                                       std::pair{"tibial_torsion", "l"}, std::pair{"hka", "r"}}) {
    if (figure(before, quantity, side).determined) continue;
    const FigureAdvice& advice = adviceOf(before, quantity, side);
    EXPECT_TRUE(advice.enough) << quantity;
    ASSERT_FALSE(advice.landmarks.empty()) << quantity;
    auto names = kCentres;
    names.insert(names.end(), advice.landmarks.begin(), advice.landmarks.end());
    EXPECT_TRUE(figure(fit(seen(names)), quantity, side).determined) << quantity;
    names.pop_back();  // the last was needed
    EXPECT_FALSE(figure(fit(seen(names)), quantity, side).determined) << quantity;
  }
}

TEST_F(JudgedFigures, EverythingPickedNeedsNoAdvice) {
  EXPECT_TRUE(fit(seen(protocol)).advice.empty());
}

TEST(FigureLimits, EveryFigureHasOneWithItsReason) {
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  for (const auto& f : boneFigures(skeleton, {}, zeroPosture(skeleton)))
    EXPECT_EQ(std::ranges::count(figureLimits(), f.quantity, &FigureLimit::quantity), 1) << f.quantity;
  for (const auto& limit : figureLimits()) EXPECT_GT(std::string{limit.reason}.size(), 10u) << limit.quantity;
}

}  // namespace
}  // namespace sinew
