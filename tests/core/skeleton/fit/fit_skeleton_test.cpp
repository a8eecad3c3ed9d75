#include "core/skeleton/fit/fit_skeleton.h"
#include "core/angle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/shape/population.h"
#include "tests/support/resources.h"
#include "tests/support/synthetic_views.h"

namespace sinew {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

class FitSkeleton : public testing::Test {
 protected:
  FitSkeleton() {
    for (const auto& landmark : loadLandmarkProtocol(test::resourceDir())) protocol.push_back(landmark.name);
  }

  std::vector<LandmarkObservation> seen(double noise_mm = 0) {
    return test::observe(skeleton, shape, posture, views, protocol, noise_mm, random);
  }
  SkeletonFit fit(const std::vector<LandmarkObservation>& observations, const Job& job = {}) {
    return fitSkeleton(skeleton, exactViews(views), observations, priors, {}, job);
  }
  void draw(unsigned seed) {
    std::mt19937_64 body{seed};
    shape = drawShape(priors, body);
    posture = drawStandingPosture(skeleton, body);
  }
  /// Largest differences to the truth among lengths [mm] and angles [deg].
  std::pair<double, double> errors(const SkeletonFit& result) const {
    const auto truth = boneFigures(skeleton, shape, posture);
    std::pair<double, double> worst{0, 0};
    for (std::size_t i = 0; i < truth.size(); ++i) {
      double& of = truth[i].unit == "mm" ? worst.first : worst.second;
      of = std::max(of, std::abs(result.figures[i].value - truth[i].value));
    }
    return worst;
  }
  static const BoneFigure& figure(const SkeletonFit& result, const std::string& quantity, const std::string& side) {
    return *std::ranges::find_if(result.figures,
                                 [&](const auto& f) { return f.quantity == quantity && f.side == side; });
  }
  void expectExact(const SkeletonFit& result) const {
    ASSERT_EQ(result.outcome, Outcome::Converged);
    const auto [mm, deg] = errors(result);
    EXPECT_LT(mm, 0.1);  // required of noise-free landmarks
    EXPECT_LT(deg, 0.1);
    for (const auto& f : result.figures) EXPECT_TRUE(f.determined) << f.quantity << " " << f.side;
  }

  Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  std::vector<ShapePrior> priors = loadShapePriors(test::resourceDir());
  std::vector<View> views = test::coneBeamPair();
  std::vector<std::string> protocol;
  ShapeParameters shape;
  Posture posture = zeroPosture(skeleton);
  std::mt19937_64 random{1};
};

TEST_F(FitSkeleton, FindsTheBodyThatMadeTheSightings) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    draw(seed);
    views = seed == 2 ? test::slotScanPair() : test::coneBeamPair();
    const SkeletonFit result = fit(seen());
    expectExact(result);
    EXPECT_LT(result.rms_px, 0.05);
    EXPECT_EQ(result.warnings.size(), 0u) << (result.warnings.empty() ? "" : result.warnings[0].message);
  }
}

TEST_F(FitSkeleton, FindsAChildOfHalfTheSize) {
  std::vector<double> values = toVector(shape);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!isShapeAngle(shapeParameterNames()[i])) values[i] *= 0.5;
  shape = shapeFromVector(values);
  expectExact(fit(seen()));
}

TEST_F(FitSkeleton, FindsATurnedPatientAndACrouch) {
  draw(4);
  const auto turned = [&](double yaw_deg) {
    Posture q = posture;
    q.segment<3>(3) = Eigen::Vector3d{0, yaw_deg * kRadPerDeg, 0};
    return q;
  };
  for (const double yaw_deg : {30.0, -90.0, 175.0}) {
    posture = turned(yaw_deg);
    expectExact(fit(seen()));
  }
  posture = postureFromDegrees(skeleton, {{"hip_flexion_r", 55},
                                          {"knee_flexion_r", 70},
                                          {"ankle_dorsiflexion_r", 15},
                                          {"hip_flexion_l", 40},
                                          {"knee_flexion_l", 50},
                                          {"hip_adduction_l", 15},
                                          {"hip_internal_rotation_l", 30},
                                          {"pelvis_tilt", -20}});
  expectExact(fit(seen()));
}

TEST_F(FitSkeleton, FindsThePatientInALaboratoryFrame) {
  // The whole laboratory turned and shifted: nothing is vertical any more, lengths and torsions stay.
  draw(5);
  const auto truth = boneFigures(skeleton, shape, posture);
  const auto sightings = seen();
  const Eigen::Matrix3d R = rotationFromVector<double>(Eigen::Vector3d{1.1, -0.7, 1.9});
  for (auto& view : views) {
    view.p_CW -= view.R_CW * R * Eigen::Vector3d{0.3, -1, 2};
    view.R_CW = view.R_CW * R;
  }
  const SkeletonFit result = fit(sightings);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i].quantity == "pelvic_tilt" || truth[i].quantity == "pelvic_obliquity") continue;
    EXPECT_NEAR(result.figures[i].value, truth[i].value, 0.1) << truth[i].quantity;
  }
}

TEST_F(FitSkeleton, NoisyPicksGiveHonestIntervals) {
  draw(6);
  const SkeletonFit result = fit(seen(1.0));
  ASSERT_EQ(result.outcome, Outcome::Converged);
  const auto truth = boneFigures(skeleton, shape, posture);
  int covered = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto& f = result.figures[i];
    EXPECT_TRUE(f.determined) << f.quantity;
    EXPECT_LT(f.lower95, f.value);
    EXPECT_GT(f.upper95, f.value);
    covered += truth[i].value > f.lower95 && truth[i].value < f.upper95;
  }
  EXPECT_GE(covered, 17);  // of 20 at 95 %: fewer has a chance below 2 %
  EXPECT_NEAR(result.rms_px, std::sqrt(2.0) * 5.9, 1.2);
}

TEST_F(FitSkeleton, LeftForRightIsSaidFirst) {
  draw(7);
  auto sightings = seen(1.0);
  for (auto& s : sightings) {
    if (s.landmark.ends_with("_r"))
      s.landmark.back() = 'l';
    else if (s.landmark.ends_with("_l"))
      s.landmark.back() = 'r';
  }
  const SkeletonFit result = fit(sightings);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(result.warnings.front().code, "picks_disagree");
}

TEST_F(FitSkeleton, AGrossErrorIsNamedAndBarelyMovesTheResult) {
  draw(7);
  auto sightings = seen(1.0);
  const SkeletonFit clean = fit(sightings);
  const auto wrong = std::ranges::find(sightings, "medial_epicondyle_l", &LandmarkObservation::landmark);
  wrong->uv_px += Eigen::Vector2d{-150, 90};
  const SkeletonFit result = fit(sightings);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  ASSERT_THAT(result.warnings, Contains(Field(&Warning::code, "outlier")));
  EXPECT_THAT(result.warnings.front().message, HasSubstr("medial_epicondyle_l in view 1"));
  EXPECT_NEAR(figure(result, "femur_length", "l").value, figure(clean, "femur_length", "l").value, 2);
  EXPECT_NEAR(figure(result, "femoral_torsion", "l").value, figure(clean, "femoral_torsion", "l").value, 3);
  const auto& residual = *std::ranges::find(result.residuals, "medial_epicondyle_l", &LandmarkResidual::landmark);
  EXPECT_GT(residual.sigmas, 20);
  EXPECT_LT(residual.residual_px.x(), -100);  // observed minus projected
}

TEST_F(FitSkeleton, SeveralGrossErrorsAreLeftOutAndNamed) {
  draw(7);
  auto sightings = seen(1.0);
  for (const std::size_t i : {3u, 20u, 41u, 62u, 87u}) sightings[i].uv_px += Eigen::Vector2d{250, -180};
  const SkeletonFit result = fit(sightings);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_EQ(std::ranges::count_if(result.warnings,
                                  [](const Warning& w) { return w.message.find("left out") != std::string::npos; }),
            5);
  for (const std::size_t i : {87u, 62u, 41u, 20u, 3u}) sightings.erase(sightings.begin() + static_cast<long>(i));
  const SkeletonFit without = fit(sightings);
  for (std::size_t i = 0; i < without.figures.size(); ++i) {
    EXPECT_NEAR(result.figures[i].value, without.figures[i].value, 1e-3) << without.figures[i].quantity;
    EXPECT_NEAR(result.figures[i].upper95, without.figures[i].upper95, 1e-3) << without.figures[i].quantity;
  }
}

TEST_F(FitSkeleton, ASeverelyDeformedLegIsNotPulledBackToThePopulation) {
  shape.sides[0].femur.torsion_rad = -50 * kRadPerDeg;  // anteversion of 62 deg
  shape.sides[0].femur.varus_rad = 22 * kRadPerDeg;
  shape.sides[0].tibia.torsion_rad = 35 * kRadPerDeg;
  shape.sides[1].femur.elongation = 0.85;
  posture = postureFromDegrees(skeleton, {{"knee_flexion_r", 40}, {"hip_flexion_r", 30}});
  expectExact(fit(seen()));
  const SkeletonFit noisy = fit(seen(1.0));
  const auto truth = boneFigures(skeleton, shape, posture);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double sd = (noisy.figures[i].upper95 - noisy.figures[i].lower95) / 3.92;
    EXPECT_LT(std::abs(noisy.figures[i].value - truth[i].value), 4 * sd) << truth[i].quantity << truth[i].side;
  }
}

TEST_F(FitSkeleton, AWrongGeometryIsSaid) {
  draw(3);
  const auto sightings = seen(1.0);
  test::placeView(views[1], -Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(), {0.05, 0.58, -1.6});  // moved
  const SkeletonFit result = fit(sightings);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_THAT(result.warnings, Contains(Field(&Warning::code, "residuals_exceed_sigma")));
  EXPECT_GT(result.rms_px, 30);  // not explained away by leaving out most of the sightings
}

TEST_F(FitSkeleton, SaysWhatTheImagesDoNotShow) {
  draw(8);
  std::erase_if(protocol, [](const std::string& name) {
    return name.ends_with("_l") || name.starts_with("medial_mall") || name.starts_with("lateral_mall") ||
           name.starts_with("tibial_plafond") || name.starts_with("talar") || name.starts_with("calc") ||
           name.starts_with("metatarsal");
  });
  const SkeletonFit result = fit(seen(1.0));
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_TRUE(figure(result, "femur_length", "r").determined);
  EXPECT_TRUE(figure(result, "femoral_torsion", "r").determined);
  EXPECT_FALSE(figure(result, "tibia_length", "r").determined);
  EXPECT_FALSE(figure(result, "tibial_torsion", "r").determined);
  EXPECT_FALSE(figure(result, "femur_length", "l").determined);
  EXPECT_FALSE(figure(result, "leg_length_difference", "").determined);
  EXPECT_THAT(result.undetermined, Contains("tibia_r.torsion"));
  EXPECT_THAT(result.undetermined, Contains("femur_l.elongation"));
  EXPECT_THAT(result.undetermined, Contains("knee_flexion_l"));
  EXPECT_THAT(result.undetermined, Contains("shoulder_flexion_r"));
  EXPECT_THAT(result.undetermined, Not(Contains("femur_r.elongation")));
  EXPECT_THAT(result.undetermined, Not(Contains("hip_flexion_r")));
  // What no image shows has the size of what they show, not that of an adult; the truth lies in the wide interval.
  const double true_length = 430 * shape.sides[0].tibia.elongation;
  EXPECT_GT(figure(result, "tibia_length", "r").upper95, true_length);
  EXPECT_LT(figure(result, "tibia_length", "r").lower95, true_length);
}

TEST_F(FitSkeleton, UsesLandmarksSeenInOneView) {
  draw(9);
  auto sightings = seen(1.0);
  std::erase_if(sightings, [](const auto& s) { return s.view == 1 && s.landmark.starts_with("medial_malleolus"); });
  const SkeletonFit result = fit(sightings);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_THAT(result.warnings, Contains(Field(&Warning::code, "landmark_seen_once")));
  EXPECT_EQ(result.residuals.size(), sightings.size());
  EXPECT_TRUE(figure(result, "tibial_torsion", "l").determined);
}

TEST_F(FitSkeleton, OneRadiographAloneStillFits) {
  draw(10);
  const auto both = seen(1.0);
  auto first = both;
  std::erase_if(first, [](const auto& s) { return s.view == 1; });
  const auto width = [&](const SkeletonFit& result) {
    const auto& f = figure(result, "femoral_torsion", "r");
    return f.upper95 - f.lower95;
  };
  const SkeletonFit two = fit(both);
  views.resize(1);
  const SkeletonFit one = fit(first);
  ASSERT_EQ(one.outcome, Outcome::Converged);
  EXPECT_LT(one.rms_px, 10);
  EXPECT_GT(width(one), 1.5 * width(two));  // depth comes from the population alone
}

TEST_F(FitSkeleton, AnswersUnusableSightings) {
  auto sightings = seen();
  sightings.push_back({"medial_maleolus_r", 0, {1, 1}, 1});
  sightings.push_back({"patella_center_r", 0, {1, 1}, 1});
  const SkeletonFit result = fit(sightings);
  EXPECT_EQ(result.outcome, Outcome::Converged);
  ASSERT_GE(result.warnings.size(), 2u);
  EXPECT_THAT(result.warnings[0].message, HasSubstr("medial_malleolus_r"));
  EXPECT_EQ(result.warnings[1].code, "landmark_not_fitted");

  EXPECT_THROW(fit({}), InputError);
  EXPECT_THROW(fit({{"nonsense", 0, {1, 1}, 1}}), InputError);
  EXPECT_THROW(fit({{"asis_r", 2, {1, 1}, 1}}), InputError);
  EXPECT_THROW(fit({{"asis_r", 0, {1, 1}, 0}}), InputError);
  EXPECT_THROW(fit({{"asis_r", 0, {NAN, 1}, 1}}), InputError);
}

TEST_F(FitSkeleton, ASingleSightingDeterminesNothing) {
  const SkeletonFit result = fit({{"asis_r", 0, {1500, 3000}, 1}});
  ASSERT_EQ(result.outcome, Outcome::Converged);
  for (const auto& f : result.figures) EXPECT_FALSE(f.determined) << f.quantity;
}

TEST_F(FitSkeleton, ACancelledFitCarriesNoNumbers) {
  std::stop_source stop;
  stop.request_stop();
  const SkeletonFit result = fit(seen(1.0), Job{.report_to = {}, .stop = stop.get_token()});
  EXPECT_EQ(result.outcome, Outcome::Cancelled);
  EXPECT_TRUE(std::isnan(result.rms_px));
  EXPECT_TRUE(result.figures.empty());
}

TEST_F(FitSkeleton, ReportsProgressAndStopsWhenAsked) {
  std::stop_source stop;
  double last = -1;
  Job job{.report_to = {}, .stop = stop.get_token()};
  job.report_to = [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, last);
    last = fraction;
    if (fraction > 0.5) stop.request_stop();
  };
  EXPECT_EQ(fit(seen(1.0), job).outcome, Outcome::Cancelled);
  EXPECT_GT(last, 0.5);
}

TEST_F(FitSkeleton, TooFewIterationsAreSaidAndCarryNoNumbers) {
  draw(11);
  const SkeletonFit result = fitSkeleton(skeleton, exactViews(views), seen(1.0), priors, {.max_iterations = 1});
  EXPECT_EQ(result.outcome, Outcome::NotConverged);
  EXPECT_TRUE(std::isnan(result.rms_px));
  EXPECT_TRUE(result.figures.empty());
}

TEST_F(FitSkeleton, TheSameSightingsGiveTheSameNumbers) {
  draw(12);
  const auto sightings = seen(1.0);
  const SkeletonFit a = fit(sightings), b = fit(sightings);
  EXPECT_EQ(a.shape, b.shape);
  EXPECT_EQ(a.posture, b.posture);
}

}  // namespace
}  // namespace sinew
