#include "imaging/calibration/calibrate.h"

#include <ceres/gradient_checker.h>
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <random>

#include "imaging/calibration/bead_residuals.h"
#include "imaging/calibration/calibration_internal.h"
#include "imaging/rig/triangulate.h"
#include "tests/imaging/calibration/bead_image.h"
#include "tests/imaging/rigs.h"

namespace sinew {
namespace {

using testing::HasSubstr;

/// The pair that is to be recovered; small images keep the tests quick.
BiplanarRig truth() {
  BiplanarRig rig = test::coneBeamRig();
  for (std::size_t i = 0; i < 2; ++i) {
    View& v = rig.views[i];
    v.projection = ConeBeam{3000 + 40.0 * double(i), 3000 + 40.0 * double(i), 712 - 25.0 * double(i), 1390};
    v.width_px = 1400;
    v.height_px = 2800;
    v.R_CW = v.R_CW * rotationFromVector<double>({0.02, -0.05, 0.03});
    v.p_CW = {0.03, -0.04, 1.5};
  }
  return rig;
}

/// What the DICOM tags would have said: principal point in the middle, distances 2 % off, object upright.
BiplanarRig guess() {
  BiplanarRig rig = truth();
  const auto R = test::frontalAndLateral();
  for (std::size_t i = 0; i < 2; ++i) {
    rig.views[i].projection = ConeBeam{2940, 2940, 699.5, 1399.5};
    rig.views[i].R_CW = R[i];
    rig.views[i].p_CW = {0, 0, 1.5};
  }
  return rig;
}

std::array<std::vector<DetectedBead>, 2> detections(const CalibrationObject& object, const BiplanarRig& rig) {
  std::array<std::vector<DetectedBead>, 2> out;
  for (std::size_t view = 0; view < 2; ++view)
    for (const auto& s : test::shadowsOf(object, rig.views[view]))
      out[view].push_back({s.uv_px, 2 * 0.93 * s.radius_px, 1000, 0.05});
  return out;
}

std::vector<Sighting> sightingsOf(const CalibrationObject& object, const BiplanarRig& rig, double sigma_px,
                                  unsigned seed) {
  std::mt19937 random{seed};
  std::normal_distribution<double> normal;
  std::vector<Sighting> out;
  for (const auto& bead : object.beads)
    for (int view : {0, 1}) {
      Sighting s = test::see(rig, view, bead.p_WQ, bead.name);
      s.uv_px += sigma_px * Eigen::Vector2d{normal(random), normal(random)};
      s.sigma_px = std::max(sigma_px, 0.01);
      out.push_back(s);
    }
  return out;
}

/// Largest distance between the images of points of the volume in the two rigs.
double worstDisagreement_px(const BiplanarRig& a, const BiplanarRig& b) {
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p{0.2 * std::sin(1.0 * i), 0.55 * std::sin(2.3 * i), 0.25 * std::sin(3.7 * i)};
    for (std::size_t view = 0; view < a.views.size(); ++view)
      worst = std::max(worst, (*project(a.views[view], p) - *project(b.views[view], p)).norm());
  }
  return worst;
}

const std::array<Eigen::Vector2i, 2> kSizes{Eigen::Vector2i{1400, 2800}, Eigen::Vector2i{1400, 2800}};

TEST(Calibrate, RecoversTheRigFromUnnamedBeads) {
  const auto object = defaultCalibrationObject();
  const auto result = calibrateFromBeads(object, detections(object, truth()), guess());
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_LT(worstDisagreement_px(result.rig, truth()), 0.001);  // exact data
  EXPECT_LT(result.rms_px, 1e-4);
  EXPECT_EQ(result.residuals.size(), 64u);
  EXPECT_TRUE(result.unmatched_beads[0].empty() && result.unmatched_beads[1].empty());
  EXPECT_TRUE(result.rig.patient_aligned);
  EXPECT_EQ(result.rig.calibration.method, "bead_phantom");
  EXPECT_EQ(result.rig.calibration.id, geometryId(result.rig.views));
  EXPECT_THAT(result.rig.calibration.warnings, testing::IsEmpty());
  EXPECT_LT(result.accuracy_mm, 0.15);
}

TEST(Calibrate, ToleratesMissingAndSpuriousDetections) {
  const auto object = defaultCalibrationObject();
  for (const bool sizes_known : {true, false}) {
    auto seen = detections(object, truth());
    std::mt19937 random{5};
    for (auto& view : seen) {
      std::shuffle(view.begin(), view.end(), random);
      view.resize(26);
      for (int i = 0; i < 8; ++i)
        view.push_back({{double(random() % 1400), double(random() % 2800)}, 7.0 + double(i), 500, 0.05});
      std::shuffle(view.begin(), view.end(), random);
      if (!sizes_known)
        for (auto& bead : view) bead.diameter_px = 0;
    }
    const auto result = calibrateFromBeads(object, seen, guess());
    ASSERT_EQ(result.outcome, Outcome::Converged);
    EXPECT_LT(worstDisagreement_px(result.rig, truth()), 0.01) << sizes_known;
    EXPECT_EQ(result.unmatched_beads[0].size(), 6u);
    EXPECT_EQ(result.unmatched_px[1].size(), 8u);
  }
}

TEST(Calibrate, ObjectStandingElsewhereAndTurned) {
  const auto object = defaultCalibrationObject();
  for (const double sign : {-1.0, 1.0}) {
    BiplanarRig far = truth();  // the object 0.1 m and 8 deg from where the guess puts it
    for (auto& view : far.views) {
      view.p_CW += view.R_CW * Eigen::Vector3d{0.08 * sign, 0.05, -0.06 * sign};
      view.R_CW = view.R_CW * rotationFromVector<double>({0.03, 0.14 * sign, -0.02});
    }
    const auto result = calibrateFromBeads(object, detections(object, far), guess());
    ASSERT_EQ(result.outcome, Outcome::Converged);
    EXPECT_LT(worstDisagreement_px(result.rig, far), 0.001);
  }
}

TEST(Calibrate, MirroredFilm) {
  const auto object = defaultCalibrationObject();
  BiplanarRig mirrored = truth(), start = guess();
  for (BiplanarRig* rig : {&mirrored, &start}) {
    rig->views[0].R_CW.row(0) *= -1;
    rig->views[0].p_CW[0] *= -1;
  }
  const auto result = calibrateFromBeads(object, detections(object, mirrored), start);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_LT(worstDisagreement_px(result.rig, mirrored), 0.001);
  const auto named = calibrateFromSightings(object, sightingsOf(object, mirrored, 0, 1), kSizes);
  ASSERT_EQ(named.outcome, Outcome::Converged);
  EXPECT_LT(worstDisagreement_px(named.rig, mirrored), 0.001);
}

TEST(Calibrate, FromRenderedImages) {
  const auto object = defaultCalibrationObject();
  std::array<std::vector<DetectedBead>, 2> seen;
  for (std::size_t view = 0; view < 2; ++view) {
    auto shadows = test::shadowsOf(object, truth().views[view]);
    seen[view] = detectBeads(test::drawShadows(1400, 2800, shadows, 200, unsigned(view) + 1));
    EXPECT_GE(seen[view].size(), 30u);
  }
  const auto result = calibrateFromBeads(object, seen, guess());
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_LT(result.rms_px, 0.15);
  EXPECT_LT(worstDisagreement_px(result.rig, truth()), 0.2);
  if (std::getenv("SINEW_PRINT_RESIDUALS"))
    std::printf("rendered phantom: %zu + %zu beads, rms %.3f px, worst %.3f px, accuracy %.3f mm\n", seen[0].size(),
                seen[1].size(), result.rms_px, worstDisagreement_px(result.rig, truth()), result.accuracy_mm);
}

TEST(Calibrate, StatedAccuracyIsThatOfNewPoints) {
  const auto object = defaultCalibrationObject();
  CalibrationOptions options;
  options.bead_position_sigma_mm = 0.001;
  constexpr double kSigma_px = 0.3;
  double sum_mm2 = 0, stated_mm2 = 0;
  int points = 0;
  constexpr int kDraws = 40;
  for (unsigned draw = 1; draw <= kDraws; ++draw) {
    const auto result =
        calibrateFromSightings(object, sightingsOf(object, truth(), kSigma_px, draw), kSizes, options);
    ASSERT_EQ(result.outcome, Outcome::Converged);
    stated_mm2 += result.accuracy_mm * result.accuracy_mm / kDraws;
    const auto fresh = sightingsOf(object, truth(), kSigma_px, 1000 + draw);  // other noise than it was made from
    const auto found = triangulateAll(result.rig, fresh);
    for (std::size_t i = 0; i < found.points.size(); ++i, ++points)
      sum_mm2 += 1e6 * (found.points[i].p_WL - object.beads[i].p_WQ).squaredNorm();
  }
  const double actual_mm = std::sqrt(sum_mm2 / points);
  EXPECT_NEAR(actual_mm / std::sqrt(stated_mm2), 1, 0.15);
  if (std::getenv("SINEW_PRINT_RESIDUALS"))
    std::printf("new points: %.4f mm, stated %.4f mm\n", actual_mm, std::sqrt(stated_mm2));
}

TEST(Calibrate, DropsAWronglyPickedBead) {
  const auto object = defaultCalibrationObject();
  auto sightings = sightingsOf(object, truth(), 0.1, 3);
  sightings[10].uv_px.x() += 9;
  const auto result = calibrateFromSightings(object, sightings, kSizes);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_THAT(result.unmatched_beads[0], testing::ElementsAre(sightings[10].name));
  EXPECT_LT(worstDisagreement_px(result.rig, truth()), 0.5);
}

TEST(Calibrate, FindsTheDistortionOfAnImageIntensifier) {
  const auto object = defaultCalibrationObject();
  BiplanarRig bent = truth();
  for (auto& view : bent.views) std::get<ConeBeam>(view.projection).k1 = 0.08;
  CalibrationOptions options;
  options.estimate_distortion = EstimatedDistortion::FirstRadial;
  const auto result = calibrateFromSightings(object, sightingsOf(object, bent, 0, 1), kSizes, options);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_NEAR(std::get<ConeBeam>(result.rig.views[0].projection).k1, 0.08, 1e-4);
}

/// Bends all views; mild, as of a good image intensifier.
BiplanarRig bentInFull(BiplanarRig rig) {
  for (auto& view : rig.views) {
    auto& c = std::get<ConeBeam>(view.projection);
    c.k1 = 0.08, c.k2 = -0.05, c.p1 = 2e-3, c.p2 = -3e-3, c.k3 = 0.04;
  }
  return rig;
}

TEST(Calibrate, FindsEveryTermOfTheDistortion) {
  const auto object = defaultCalibrationObject();
  const BiplanarRig bent = bentInFull(truth());
  CalibrationOptions options;
  options.estimate_distortion = EstimatedDistortion::Full;
  const auto result = calibrateFromSightings(object, sightingsOf(object, bent, 0, 1), kSizes, options);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_LT(worstDisagreement_px(result.rig, bent), 0.01);  // exact data
  const auto &found = std::get<ConeBeam>(result.rig.views[0].projection),
             &made = std::get<ConeBeam>(bent.views[0].projection);
  EXPECT_NEAR(found.k1, made.k1, 1e-3);
  EXPECT_NEAR(found.p1, made.p1, 1e-5);
  EXPECT_NEAR(found.p2, made.p2, 1e-5);
}

TEST(Calibrate, KeepsTheDistortionOfTheGuess) {
  // What is known of the detector is not an unknown, and is not forgotten: exact beads give the exact views.
  const auto object = defaultCalibrationObject();
  const BiplanarRig bent = bentInFull(truth());
  const auto result = calibrateFromBeads(object, detections(object, bent), bentInFull(guess()));
  ASSERT_EQ(result.outcome, Outcome::Converged);
  EXPECT_LT(worstDisagreement_px(result.rig, bent), 0.01);
  EXPECT_EQ(std::get<ConeBeam>(result.rig.views[1].projection).k3, 0.04);
}

TEST(Calibrate, ThreeViewsAtOnce) {
  const auto object = defaultCalibrationObject();
  BiplanarRig three = truth(), start = guess();
  for (BiplanarRig* rig : {&three, &start}) {
    RigView oblique = rig->views[0];
    oblique.R_CW = oblique.R_CW * rotationFromVector<double>({0, 0.7, 0});
    oblique.role = ViewRole::Oblique;
    oblique.exposure = 2;
    rig->views.push_back(oblique);
  }
  std::vector<std::vector<DetectedBead>> seen;
  for (const auto& view : three.views) {
    seen.emplace_back();
    for (const auto& s : test::shadowsOf(object, view)) seen.back().push_back({s.uv_px, 0, 1000, 0.05});
  }
  const auto result = calibrateFromBeads(object, seen, start);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  ASSERT_EQ(result.rig.views.size(), 3u);
  EXPECT_LT(worstDisagreement_px(result.rig, three), 0.001);
  EXPECT_EQ(result.rig.views[2].role, ViewRole::Oblique);
  EXPECT_EQ(result.rig.views[2].exposure, 2);
  const auto two = calibrateFromBeads(object, std::array{seen[0], seen[1]}, guess());
  EXPECT_LT(result.accuracy_mm, two.accuracy_mm);  // a third view sees the point, too
}

std::string errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Calibrate, RefusesWhatDoesNotDetermineTheGeometry) {
  auto object = defaultCalibrationObject();
  const auto seen = detections(object, truth());
  auto few = seen;
  few[1].resize(6);
  EXPECT_THAT(errorOf([&] { calibrateFromBeads(object, few, guess()); }), HasSubstr("view 2: beads"));
  EXPECT_THAT(errorOf([&] { calibrateFromBeads(object, seen, test::slotScanRig()); }), HasSubstr("cone beam"));

  auto sightings = sightingsOf(object, truth(), 0, 1);
  sightings[0].name = "S99";
  EXPECT_THAT(errorOf([&] { calibrateFromSightings(object, sightings, kSizes); }), HasSubstr("'S99'; nearest: "));
  for (auto& bead : object.beads) bead.p_WQ.x() = 0.02 * bead.p_WQ.y();  // a board
  EXPECT_THAT(errorOf([&] { calibrateFromSightings(object, sightingsOf(object, truth(), 0, 1), kSizes); }),
              HasSubstr("fill a volume"));
}

TEST(Calibrate, CancelledCarriesNoNumbers) {
  const auto object = defaultCalibrationObject();
  std::stop_source stop;
  stop.request_stop();
  const auto result = calibrateFromBeads(object, detections(object, truth()), guess(), {}, {{}, stop.get_token()});
  EXPECT_EQ(result.outcome, Outcome::Cancelled);
  EXPECT_TRUE(std::isnan(result.rms_px));
}

TEST(ViewFromDlt, RecoversAPinholeAndItsMirror) {
  for (const double mirror : {1.0, -1.0}) {
    View view = truth().views[0];
    view.R_CW.row(0) *= mirror;
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector2d> uv;
    for (const auto& bead : defaultCalibrationObject().beads) {
      points.push_back(bead.p_WQ);
      uv.push_back(*project(view, bead.p_WQ));
    }
    const auto found = viewFromDlt(points, uv);
    ASSERT_TRUE(found);
    EXPECT_LT((found->R_CW - view.R_CW).norm(), 1e-8);
    EXPECT_LT((found->p_CW - view.p_CW).norm(), 1e-8);
    EXPECT_NEAR(std::get<ConeBeam>(found->projection).fx_px, 3000, 1e-5);
    EXPECT_NEAR(std::get<ConeBeam>(found->projection).cy_px, 1390, 1e-5);
    for (auto& p : points) p.z() = 0;
    EXPECT_FALSE(viewFromDlt(points, uv));
  }
}

TEST(BeadResiduals, ByHandAndByGradientCheck) {
  const BeadProjectionResidual residual{{110, 205}, 2.0, Eigen::Matrix3d::Identity(), 1.5};
  const double intrinsics[] = {1000, 100, 200, 0.1, -40, 0.02, -0.03, 9}, pose[] = {0, 0, 0, 0, 0, 1},
               bead[] = {0.02, -0.01, 1.0};
  double out[2];
  ASSERT_TRUE(residual(intrinsics, pose, bead, out));
  // x = 0.02 / 2, y = -0.01 / 2, r^2 = 1.25e-4; Brown's polynomial by hand.
  const double x = 0.01, y = -0.005, r2 = 1.25e-4, radial = 1 + 0.1 * r2 - 40 * r2 * r2 + 9 * r2 * r2 * r2;
  const double bent_x = x * radial + 2 * 0.02 * x * y - 0.03 * (r2 + 2 * x * x);
  const double bent_y = y * radial + 0.02 * (r2 + 2 * y * y) - 2 * 0.03 * x * y;
  EXPECT_NEAR(out[0], (110 - (1000 * bent_x + 100)) / 2, 1e-12);
  EXPECT_NEAR(out[1], (205 - (1500 * bent_y + 200)) / 2, 1e-12);
  const double behind[] = {0, 0, -3.0};
  EXPECT_FALSE(residual(intrinsics, pose, behind, out));

  const std::unique_ptr<ceres::CostFunction> cost{
      BeadProjectionResidual::create({110, 205}, 2.0, Eigen::Matrix3d::Identity(), 1.5)};
  const double turned[] = {0.1, -0.2, 0.05, 0.01, 0.02, 1};
  const double* parameters[] = {intrinsics, turned, bead};
  ceres::GradientChecker checker{cost.get(), static_cast<std::vector<const ceres::Manifold*>*>(nullptr), {}};
  ceres::GradientChecker::ProbeResults probe;
  EXPECT_TRUE(checker.Probe(parameters, 1e-7, &probe)) << probe.error_log;
}

}  // namespace
}  // namespace sinew
