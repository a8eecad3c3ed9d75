#include "imaging/rig/triangulate.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/imaging/rigs.h"

namespace sinew {
namespace {

using test::see;

const Eigen::Vector3d kKnee{0.03, -0.12, 0.09};

std::vector<std::string> codes(const Warnings& warnings) {
  std::vector<std::string> out;
  for (const auto& w : warnings) out.push_back(w.code);
  return out;
}

class EveryRig : public testing::TestWithParam<BiplanarRig> {};
INSTANTIATE_TEST_SUITE_P(Triangulate, EveryRig, testing::Values(test::coneBeamRig(), test::slotScanRig()),
                         [](const auto& one) { return projectionName(one.param.views[0]); });

TEST_P(EveryRig, FindsThePointThatWasProjected) {
  const BiplanarRig rig = GetParam();
  const auto point = triangulate(rig, std::vector{see(rig, 0, kKnee), see(rig, 1, kKnee)});
  ASSERT_TRUE(point);
  EXPECT_LT((point->p_WL - kKnee).norm(), 1e-10);  // exact data: rounding only
  EXPECT_LT(point->reprojection_rms_px, 1e-7);
}

TEST_P(EveryRig, StatesTheCovarianceThatRepeatedPicksHave) {
  const BiplanarRig rig = GetParam();
  std::mt19937 random{7};
  std::normal_distribution<double> normal;
  std::vector<Sighting> pair{see(rig, 0, kKnee), see(rig, 1, kKnee)};
  pair[0].sigma_px = 2.0;
  pair[1].sigma_px = 5.0;
  const Eigen::Matrix3d stated = triangulate(rig, pair)->cov_W;

  constexpr int kDraws = 2000;
  Eigen::Matrix3d empirical = Eigen::Matrix3d::Zero();
  for (int draw = 0; draw < kDraws; ++draw) {
    auto noisy = pair;
    for (auto& s : noisy) s.uv_px += s.sigma_px * Eigen::Vector2d{normal(random), normal(random)};
    const Eigen::Vector3d error = triangulate(rig, noisy)->p_WL - kKnee;
    empirical += error * error.transpose() / kDraws;
  }
  // Whitened by what was stated, the draws' covariance is the identity; 2000 draws: SD of a variance 3 %.
  const Eigen::Matrix3d whitener = stated.llt().matrixL().toDenseMatrix().inverse();
  const Eigen::Matrix3d identity = whitener * empirical * whitener.transpose();
  EXPECT_LT((identity - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.15) << identity;
}

TEST_P(EveryRig, EpipolarLineOfAPickPassesThroughItsPartner) {
  const BiplanarRig rig = GetParam();
  for (int view : {0, 1}) {
    const auto line = epipolarLine(rig, view, see(rig, view, kKnee).uv_px, 1 - view);
    const Eigen::Vector2d partner = see(rig, 1 - view, kKnee).uv_px;
    ASSERT_EQ(line.size(), 2u);  // straight
    const Eigen::Vector2d along = (line[1] - line[0]).normalized(), off = partner - line[0];
    EXPECT_LT(std::abs(along.x() * off.y() - along.y() * off.x()), 0.05);
    EXPECT_GT((line[1] - line[0]).norm(), 0.8 * rig.views[0].width_px);  // right across the image
  }
}

TEST(Triangulate, SlotScanPartnerLiesInTheSameRow) {
  const BiplanarRig rig = test::slotScanRig();
  for (const auto& p : epipolarLine(rig, 0, {700, 3210.5}, 1)) EXPECT_NEAR(p.y(), 3210.5, 1e-9);
}

TEST(Triangulate, SlotScanAgreesWithTheClosedForm) {
  // u = X d_A / (d_A + depth), solved by hand for both views: X = u (1 + v/d_A) / (1 - u v / (d_A d_L)) and so on.
  const BiplanarRig rig = test::slotScanRig();
  const auto& a = std::get<SlotScan>(rig.views[0].projection);
  const auto& l = std::get<SlotScan>(rig.views[1].projection);
  const std::vector pair{Sighting{"L", 0, {700, 3210}, 1}, Sighting{"L", 1, {1010, 3210}, 1}};
  const double dA = a.source_to_isocenter_m, dL = l.source_to_isocenter_m;
  const double u = (700 - a.u0_px) * a.column_spacing_m, v = (1010 - l.u0_px) * l.column_spacing_m;
  // Frontal: x_C = -Z, depth = -X. Lateral: x_C = X, depth = -Z. So X = v (1 + zL/dL), -Z = u (1 + zA/dA).
  const double minus_Z = u * (1 - v / dA) / (1 + u * v / (dA * dL)), X = v * (1 + minus_Z / dL);
  const auto point = triangulate(rig, pair);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->p_WL.x(), X, 1e-9);
  EXPECT_NEAR(point->p_WL.z(), -minus_Z, 1e-9);
  EXPECT_NEAR(point->p_WL.y(), (a.v0_px - 3210) * a.row_spacing_m, 1e-12);
}

TEST(Triangulate, HasNoAnswerForNearlyParallelRays) {
  BiplanarRig rig = test::coneBeamRig();
  for (const auto& [angle_deg, answers] : {std::pair{3.0, false}, {7.0, true}}) {
    rig.views[1] = rig.views[0];
    rig.views[1].R_CW =
        rig.views[0].R_CW * Eigen::AngleAxisd{angle_deg * M_PI / 180, Eigen::Vector3d::UnitY()}.toRotationMatrix();
    const std::vector pair{see(rig, 0, {0, 0, 0}), see(rig, 1, {0, 0, 0})};
    EXPECT_EQ(triangulate(rig, pair).has_value(), answers) << angle_deg;
  }
}

TEST(Triangulate, RefusesTwoSightingsOfOneView) {
  const BiplanarRig rig = test::coneBeamRig();
  EXPECT_THROW(triangulate(rig, std::vector{see(rig, 0, kKnee), see(rig, 0, kKnee)}), InputError);
  EXPECT_THROW(triangulate(rig, std::vector{see(rig, 0, kKnee)}), InputError);
}

std::vector<Sighting> seeMany(const BiplanarRig& rig) {
  std::vector<Sighting> all;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d p{0.02 * i - 0.05, 0.15 * i - 0.3, 0.03 * (i % 3)};
    for (int view : {0, 1}) all.push_back(see(rig, view, p, "L" + std::to_string(i)));
  }
  return all;
}

TEST(TriangulateAll, IsSilentAboutGoodSightings) {
  const BiplanarRig rig = test::coneBeamRig();
  const auto result = triangulateAll(rig, seeMany(rig));
  EXPECT_EQ(result.points.size(), 6u);
  EXPECT_LT(result.rms_px, 1e-6);
  EXPECT_THAT(result.warnings, testing::IsEmpty());
}

TEST(TriangulateAll, NamesTheGrossMismatchAndTheSingleSighting) {
  const BiplanarRig rig = test::coneBeamRig();
  auto sightings = seeMany(rig);
  sightings[5].uv_px.y() += 40;  // L2 in view 2
  sightings.pop_back();          // L5 in view 2
  const auto result = triangulateAll(rig, sightings);
  EXPECT_THAT(codes(result.warnings), testing::UnorderedElementsAre("seen_once", "gross_mismatch"));
  for (const auto& w : result.warnings)
    EXPECT_THAT(w.message, testing::HasSubstr(w.code == "seen_once" ? "'L5'" : "'L2'"));
}

TEST(TriangulateAll, NamesPicksOfTheOtherView) {
  const BiplanarRig rig = test::coneBeamRig();
  auto sightings = seeMany(rig);
  for (auto& s : sightings) s.view = 1 - s.view;
  EXPECT_THAT(codes(triangulateAll(rig, sightings).warnings), testing::Contains("swapped_views"));
}

/// The picks as somebody who counts rows from below would write them.
std::vector<Sighting> countedFromBelow(const BiplanarRig& rig, std::initializer_list<int> views) {
  auto sightings = seeMany(rig);
  for (auto& s : sightings)
    if (std::ranges::count(views, s.view)) s.uv_px.y() = rig.views[std::size_t(s.view)].height_px - 1 - s.uv_px.y();
  return sightings;
}

TEST(TriangulateAll, NamesTheViewWhoseRowsWereCountedFromBelow) {
  const BiplanarRig rig = test::coneBeamRig();
  for (int flipped : {0, 1}) {
    const auto result = triangulateAll(rig, countedFromBelow(rig, {flipped}));
    ASSERT_THAT(codes(result.warnings), testing::Contains("flipped_y"));
    EXPECT_THAT(result.warnings.back().message, testing::HasSubstr("view " + std::to_string(flipped + 1)));
  }
}

// The middles of the two films lie at different rows, and one camera may look down besides: the mirror image of the
// patient does not explain it.
TEST(TriangulateAll, NamesBothViewsWhoseRowsWereCountedFromBelow) {
  BiplanarRig tilted = test::coneBeamRig();
  const auto level = triangulateAll(tilted, countedFromBelow(tilted, {0, 1}));
  ASSERT_THAT(codes(level.warnings), testing::Contains("flipped_y"));
  EXPECT_THAT(level.warnings.back().message, testing::HasSubstr("both views"));
  tilted.views[1].R_CW = Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitX()).toRotationMatrix() * tilted.views[1].R_CW;
  const auto result = triangulateAll(tilted, countedFromBelow(tilted, {0, 1}));
  ASSERT_THAT(codes(result.warnings), testing::Contains("flipped_y"));
  EXPECT_THAT(result.warnings.back().message, testing::HasSubstr("both views"));
}

}  // namespace
}  // namespace sinew
