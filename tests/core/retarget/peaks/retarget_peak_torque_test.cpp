#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/muscle/hill.h"
#include "core/retarget/peaks/peak_condition_internal.h"
#include "core/retarget/peaks/peak_reach.h"
#include "core/retarget/peaks/peak_rows_internal.h"
#include "core/retarget/peaks/peak_torque.h"
#include "core/retarget/peaks/ratio_force_internal.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

/// The elbow's flexors alone, about their one motion.
struct Elbow {
  Model model = loadReferenceModel(test::resourceDir());
  std::vector<JointMotion> motions;
  std::vector<std::vector<int>> units_of;

  Elbow() {
    motions = {findMotion(loadJointMotions(test::resourceDir(), model.skeleton), "elbow_flexion_r")};
    Musculature flexors;
    for (const char* name : {"brachialis_r", "brachioradialis_r", "biceps_brachii_long_head_r"})
      flexors.units.push_back(model.musculature.unit(name));
    model.musculature = flexors;
    units_of = {{0, 1, 2}};
  }
  TorqueGeometry geometry() const { return {model, motionPostures(model.skeleton, motions), units_of, motions}; }
};

TEST(PeakTorque, TheAngleOfAParabolasPeakIsFound) {
  std::vector<double> torque_Nm;
  for (int s = 0; s < TorqueGeometry::kSamples; ++s) {
    const double theta = double(s) / (TorqueGeometry::kSamples - 1);
    torque_Nm.push_back(5 - (theta - 0.61) * (theta - 0.61));
  }
  EXPECT_NEAR(peakTheta(torque_Nm), 0.61, 1e-12);
  EXPECT_TRUE(std::isnan(peakTheta(std::vector<double>(TorqueGeometry::kSamples, 0.0))));
}

TEST(PeakTorque, AKnownChangeOfRatiosIsUndone) {
  Elbow elbow;
  const TorqueGeometry geometry = elbow.geometry();
  const double wanted = peakTheta(motionTorque_Nm(elbow.model.musculature, geometry, 0));
  Musculature changed = elbow.model.musculature;
  for (MusculotendonUnit& unit : changed.units) setFiberTendonRatio(unit, 1.25);
  const auto longest_m = longestLength_m(changed.units[0]);

  const PeakTorqueResult result = optimizePeakTorque(geometry, elbow.motions, {wanted}, changed);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  const PeakTorqueAngle& angle = result.angles.front();
  EXPECT_NEAR(angle.reference_deg, elbow.motions[0].angle_deg(wanted), 1e-12);
  EXPECT_GT(std::abs(angle.before_deg - angle.reference_deg), 3);  // there was something to undo
  EXPECT_NEAR(angle.after_deg, angle.reference_deg, 2);            // the tolerance of the conditions, and some
  EXPECT_NEAR(longestLength_m(changed.units[0]), longest_m, 1e-12);
  for (const double ratio : result.ratio) EXPECT_NEAR(ratio, 1, 0.3 + 1e-9);
  // What is said is what the muscles do.
  const double after = peakTheta(motionTorque_Nm(changed, geometry, 0));
  EXPECT_NEAR(elbow.motions[0].angle_deg(after), angle.after_deg, 0.01);
}

TEST(PeakTorque, ThePapersDescentUndoesIt) {
  Elbow elbow;
  const TorqueGeometry geometry = elbow.geometry();
  const double wanted = peakTheta(motionTorque_Nm(elbow.model.musculature, geometry, 0));
  Musculature changed = elbow.model.musculature;
  for (MusculotendonUnit& unit : changed.units) setFiberTendonRatio(unit, 1.25);
  const PeakTorqueResult result = descendPeakTorque(geometry, elbow.motions, {wanted}, changed);
  ASSERT_EQ(result.outcome, Outcome::Converged);
  const PeakTorqueAngle& angle = result.angles.front();
  EXPECT_GT(std::abs(angle.before_deg - angle.reference_deg), 3);
  EXPECT_NEAR(angle.after_deg, angle.reference_deg, 0.1);  // one smooth peak: nothing stops the descent before
  for (const double ratio : result.ratio) EXPECT_NEAR(ratio, 1, 0.3 + 1e-9);
  const double after = peakTheta(motionTorque_Nm(changed, geometry, 0));
  EXPECT_NEAR(elbow.motions[0].angle_deg(after), angle.after_deg, 1e-9);
}

TEST(PeakTorque, BothMethodsStayWithinTheBoundsWhereNothingReaches) {
  for (const auto method : {optimizePeakTorque, descendPeakTorque}) {
    Elbow elbow;
    const TorqueGeometry geometry = elbow.geometry();
    const PeakTorqueResult result = method(geometry, elbow.motions, {0.0}, elbow.model.musculature, {}, {});
    ASSERT_EQ(result.outcome, Outcome::Converged);
    const PeakTorqueAngle& angle = result.angles.front();
    EXPECT_GT(std::abs(angle.after_deg - angle.reference_deg), 3);  // PeakReach says so below
    EXPECT_LE(std::abs(angle.after_deg - angle.reference_deg), std::abs(angle.before_deg - angle.reference_deg));
    for (const double ratio : result.ratio) EXPECT_NEAR(ratio, 1, 0.3 + 1e-9);
  }
}

TEST(PeakTorque, WhereTheAngleIsRightRatiosStay) {
  Elbow elbow;
  const TorqueGeometry geometry = elbow.geometry();
  const double wanted = peakTheta(motionTorque_Nm(elbow.model.musculature, geometry, 0));
  const PeakTorqueResult result = optimizePeakTorque(geometry, elbow.motions, {wanted}, elbow.model.musculature);
  for (const double ratio : result.ratio)
    EXPECT_NEAR(ratio, 1, 1e-2);  // the margin over other angles may cost a little
}

TEST(PeakTorque, TheSlopeOfTheForceWithTheRatioIsThatOfCentralDifferences) {
  const MusculotendonUnit unit = Elbow{}.model.musculature.units[0];
  RatioForce force{unit};
  const double length_m = 0.95 * (unit.optimal_fiber_length_m + unit.tendon_slack_length_m);
  CurveValue fiber;
  force.setFactor(1.1);
  const CurveValue at = force.at(length_m, fiber);
  constexpr double kStep = 1e-5;
  force.setFactor(1.1 + kStep);
  const double more = force.at(length_m, fiber).value;
  force.setFactor(1.1 - kStep);
  const double less = force.at(length_m, fiber).value;
  EXPECT_NEAR(at.slope, (more - less) / (2 * kStep), 1e-5 * unit.max_isometric_force_N);
}

TEST(PeakTorque, TheForceIsThatOfTheEquilibriumDownToSlack) {
  const MusculotendonUnit unit = Elbow{}.model.musculature.units[0];
  RatioForce force{unit};
  CurveValue fiber;
  int carried = 0;
  // From long to shorter than the tendon: past the shortest fibre, where the tendon alone slackens.
  const double first_m = longestLength_m(unit), last_m = 0.9 * unit.tendon_slack_length_m;
  for (int i = 0; i <= 4000; ++i) {
    const double length_m = first_m + (last_m - first_m) * i / 4000;
    const double expected_N = equilibrium(unit, length_m, 1).active_force_N;
    ASSERT_NEAR(force.at(length_m, fiber).value, expected_N, 1e-6 * unit.max_isometric_force_N) << length_m;
    carried += fiber.value <= kShortestFiber && expected_N > 0;
  }
  EXPECT_GT(carried, 0);  // that stretch was met
}

constexpr int kSamples = TorqueGeometry::kSamples;

TEST(PeakConditions, SayExactlyWherePeakThetaLies) {
  std::mt19937_64 random{5};
  const auto share = [&] { return double(random() >> 11) * 0x1p-53; };
  int inside = 0, outside = 0;
  for (int i = 0; i < 2000; ++i) {
    // One hump anywhere, also at an end, and some noise: often two humps.
    const double centre = share() * 1.4 - 0.2, noise = 0.05 * share();
    MotionTorques::Samples torque_Nm;
    for (int s = 0; s < kSamples; ++s)
      torque_Nm[s] = 5 - std::pow(double(s) / (kSamples - 1) - centre, 2) + noise * share();
    const double low = share() * (kSamples - 1), high = low + 4 * share();
    const double peak = peakTheta(torque_Nm) * (kSamples - 1);
    bool holds = false;
    for (const auto& conditions : peakAlternatives(low, high))
      holds = holds || std::ranges::all_of(conditions, [&](const auto& c) { return c.of(torque_Nm) >= 0; });
    ASSERT_EQ(holds, low <= peak && peak <= high) << low << " .. " << high << ": " << peak;
    ++(holds ? inside : outside);
  }
  EXPECT_GT(inside, 100);  // both kinds were met
  EXPECT_GT(outside, 100);
}

TEST(PeakReach, WhereThePeakIsItCanBe) {
  const Elbow elbow;
  const TorqueGeometry geometry = elbow.geometry();
  const double now = peakTheta(motionTorque_Nm(elbow.model.musculature, geometry, 0));
  EXPECT_EQ(peakReach(geometry, 0, elbow.motions[0], now, elbow.model.musculature), PeakReach::Within);
}

TEST(PeakReach, WhatAKnownChangeOfRatiosMovedCanBeReached) {
  const Elbow elbow;
  const TorqueGeometry geometry = elbow.geometry();
  Musculature changed = elbow.model.musculature;
  for (MusculotendonUnit& unit : changed.units) setFiberTendonRatio(unit, 1.25);
  const double wanted = peakTheta(motionTorque_Nm(changed, geometry, 0));
  EXPECT_EQ(peakReach(geometry, 0, elbow.motions[0], wanted, elbow.model.musculature), PeakReach::Within);
}

TEST(PeakReach, NoRatiosGiveAPeakWhereTheArmsVanish) {
  // Straight, the elbow's flexors have so much smaller arms than half bent that no ratio makes up for it.
  const Elbow elbow;
  const TorqueGeometry geometry = elbow.geometry();
  EXPECT_EQ(peakReach(geometry, 0, elbow.motions[0], 0, elbow.model.musculature), PeakReach::Out);
  EXPECT_EQ(peakReach(geometry, 0, elbow.motions[0], 0, elbow.model.musculature, {.tolerance_deg = 200}),
            PeakReach::Within);
}

TEST(PeakReach, OneMotionCannotHaveTwoPeaksAtOnce) {
  const Elbow elbow;
  const TorqueGeometry geometry = elbow.geometry();
  const double now = peakTheta(motionTorque_Nm(elbow.model.musculature, geometry, 0));
  const PeakWish here{0, elbow.motions[0], now}, beside{0, elbow.motions[0], now + 0.05};  // 7 deg
  const auto reach = [&](std::vector<PeakWish> wishes) {
    return peakReach(geometry, wishes, elbow.model.musculature, {.tolerance_deg = 1});
  };
  ASSERT_EQ(reach({beside}), PeakReach::Within);
  EXPECT_EQ(reach({here, here}), PeakReach::Within);
  EXPECT_EQ(reach({here, beside}), PeakReach::Out);
}

TEST(PeakRows, TheTargetIsTheMinimumWithinBounds) {
  const Elbow elbow;
  const TorqueGeometry geometry = elbow.geometry();
  MotionTorques torques{geometry, elbow.model.musculature};
  const MotionTorques::State state = torques.original();
  constexpr double kWeight = 2, kPrice = 1e-2;
  // Two torques of the motion wanted higher by 1 N m, one lower.
  std::vector<WeightedResiduals> list{
      {0, kWeight, {{1, {3, 4, 5}, {-1, 0, 0}}, {1, {9, 4, 5}, {-1, 0, 0}}, {1, {20, 4, 5}, {1, 0, 0}}}}};
  const PeakRows rows{list, torques, state};
  Eigen::VectorXd low = Eigen::VectorXd::Constant(3, -100), high = Eigen::VectorXd::Constant(3, 100);
  const Eigen::VectorXd unbounded = rows.target(state.ratio, low, high, kPrice);
  ASSERT_GT(std::abs(unbounded[0] - 1), 1e-3);  // half of that way is what the bounds of the first unit allow
  (unbounded[0] < 1 ? low : high)[0] = 0.5 * (1 + unbounded[0]);
  const Eigen::VectorXd x = rows.target(state.ratio, low, high, kPrice);
  Eigen::VectorXd gradient = 2 * kPrice * (x.array() - 1);
  for (const TorqueResidual& r : list[0].residuals) {
    Eigen::VectorXd slope(3);
    for (std::size_t u = 0; u < 3; ++u)
      slope[Eigen::Index(u)] = r.slope_1_Nm[0] * state.shares[u].slope_Nm[r.sample[0]];
    gradient += 2 * kWeight * (r.value + slope.dot(x - state.ratio)) * slope;
  }
  int held = 0;
  for (Eigen::Index u = 0; u < 3; ++u) {
    ASSERT_GE(x[u], low[u]);
    ASSERT_LE(x[u], high[u]);
    const bool is_low = x[u] == low[u], is_high = x[u] == high[u];
    held += is_low || is_high;
    if (is_low) {
      EXPECT_GT(gradient[u], 0);
    } else if (is_high) {
      EXPECT_LT(gradient[u], 0);
    } else {
      EXPECT_NEAR(gradient[u], 0, 1e-9);
    }
  }
  EXPECT_GT(held, 0);  // both kinds were met
  EXPECT_LT(held, 3);
}

}  // namespace
}  // namespace sinew
