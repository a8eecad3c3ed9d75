#include "core/muscle/hill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.h"
#include "core/muscle/musculature.h"

namespace sinew {
namespace {

/// Slope against central differences, and no jump of value or slope larger than the step explains (C1).
void expectSmooth(const std::function<CurveValue(double)>& curve, double from, double to, double max_curvature) {
  constexpr double h = 1e-6;
  for (double x = from; x <= to; x += (to - from) / 997) {
    const CurveValue f = curve(x);
    const double difference = (curve(x + h).value - curve(x - h).value) / (2 * h);
    // A corner would show as an error of half the jump in slope; curvature times h is what remains of a smooth one.
    EXPECT_NEAR(f.slope, difference, 1e-8 + max_curvature * h) << "at " << x;
  }
}

TEST(HillCurves, HaveTheValuesThatThelenPublished) {
  EXPECT_DOUBLE_EQ(activeForceLength(1).value, 1);
  EXPECT_NEAR(activeForceLength(1 + std::sqrt(0.45)).value, std::exp(-1), 1e-15);  // the width is the 1/e point
  EXPECT_EQ(passiveForceLength(1).value, 0);
  EXPECT_EQ(passiveForceLength(0.3).value, 0);
  EXPECT_NEAR(passiveForceLength(1.6).value, 1, 1e-15);                                // strain 0.6 carries F_max
  EXPECT_NEAR(passiveForceLength(1.3).value, std::expm1(2.5) / std::expm1(5), 1e-15);  // 0.0759
  EXPECT_EQ(tendonForceLength(1).value, 0);
  EXPECT_EQ(tendonForceLength(0.9).value, 0);
  EXPECT_NEAR(tendonForceLength(1.033).value, 1, 1e-14);
  EXPECT_NEAR(tendonForceLength(1 + 0.609 * 0.033).value, 0.33, 1e-3);  // end of the toe
  EXPECT_NEAR(tendonForceLength(1.03).slope * 0.033, 1.712, 1e-3);      // stiffness of the linear part
  EXPECT_NEAR(forceVelocity(0).value, 1, 1e-15);
  EXPECT_NEAR(forceVelocity(-10).value, 0, 1e-15);       // V_max
  EXPECT_NEAR(forceVelocity(-5).value, 0.5 / 3, 1e-15);  // Hill: (1 - v) / (1 + v / 0.25)
  EXPECT_NEAR(forceVelocity(1e6).value, 1.4, 1e-4);      // lengthening saturates
  EXPECT_EQ(forceVelocity(-20).value, 0);
  EXPECT_NEAR(forceVelocity(-2.5, 0).value, 0, 1e-15);  // at rest the fastest shortening is a quarter
}

TEST(HillCurves, AreSmoothWithTheStatedSlopes) {
  expectSmooth(activeForceLength, 0.2, 2, 5);
  expectSmooth(passiveForceLength, 0.9, 1.7, 100);
  expectSmooth(tendonForceLength, 0.99, 1.05, 1e5);
  expectSmooth([](double v) { return forceVelocity(v); }, -12, 5, 100);
}

TEST(HillCurves, GrowMonotonically) {
  for (double x = 0; x < 1; x += 1e-3) {
    EXPECT_LE(passiveForceLength(1 + x).value, passiveForceLength(1.001 + x).value);
    EXPECT_LE(tendonForceLength(1 + 0.1 * x).value, tendonForceLength(1.0001 + 0.1 * x).value);
    EXPECT_LE(forceVelocity(15 * x - 11).value, forceVelocity(15 * x - 10.985).value + 1e-15);
  }
}

MusculotendonUnit soleus() {
  MusculotendonUnit unit;
  unit.name = "soleus";
  unit.max_isometric_force_N = 3000;
  unit.optimal_fiber_length_m = 0.044;
  unit.tendon_slack_length_m = 0.28;
  unit.pennation_angle_at_optimal_rad = 20 * std::numbers::pi / 180;
  return unit;
}

TEST(Equilibrium, BalancesFiberAndTendonOverTheWholeRange) {
  const auto unit = soleus();
  const double cosine = std::cos(unit.pennation_angle_at_optimal_rad);
  for (const double activation : {0.0, 0.01, 0.3, 1.0}) {
    for (double length = 0.305; length < 0.36; length += 0.001) {
      const FiberState s = equilibrium(unit, length, activation);
      if (s.slack || s.normalized_fiber_length <= kShortestFiber) continue;
      const double fiber_N = 3000 * cosine *
                             (activation * activeForceLength(s.normalized_fiber_length).value +
                              passiveForceLength(s.normalized_fiber_length).value);
      const double tendon_N = 3000 * tendonForceLength(s.tendon_length_m / 0.28).value;
      EXPECT_NEAR(fiber_N, tendon_N, 1e-6);  // a millionth of a newton of 3000
      EXPECT_NEAR(s.force_N, tendon_N, 1e-6);
      EXPECT_NEAR(s.fiber_length_m * cosine + s.tendon_length_m, length, 1e-12);
    }
  }
}

TEST(Equilibrium, RecoversAStateThatWasBuiltFromTheCurves) {
  const auto unit = soleus();
  const double cosine = std::cos(unit.pennation_angle_at_optimal_rad);
  // Fibre at 1.2 and half activation; the tendon strain that carries this force, by the linear part of the curve.
  const double share = (0.5 * activeForceLength(1.2).value + passiveForceLength(1.2).value) * cosine;
  ASSERT_GT(share, 0.33);
  const double top = tendonForceLength(1.033).value, slope = tendonForceLength(1.033).slope;
  const double tendon_m = 0.28 * (1.033 - (top - share) / slope);
  const FiberState s = equilibrium(unit, 1.2 * 0.044 * cosine + tendon_m, 0.5);
  EXPECT_NEAR(s.normalized_fiber_length, 1.2, 1e-9);
  EXPECT_NEAR(s.force_N, 3000 * share, 1e-6);
  EXPECT_NEAR(s.active_force_N, 3000 * 0.5 * activeForceLength(1.2).value * cosine, 1e-6);
}

TEST(Equilibrium, ASlackUnitCarriesNothingAndKeepsAFiber) {
  const auto unit = soleus();
  for (const double length : {0.0, 0.1, 0.279, 0.285}) {
    const FiberState s = equilibrium(unit, length, 1);
    EXPECT_TRUE(s.slack);
    EXPECT_EQ(s.force_N, 0);
    EXPECT_GE(s.normalized_fiber_length, kShortestFiber);
  }
  EXPECT_TRUE(equilibrium(unit, 0.32, 0).slack);  // the passive fibre is below its optimal length
  EXPECT_NEAR(equilibrium(unit, 0.32, 0).normalized_fiber_length, 0.04 / 0.044 / std::cos(std::numbers::pi / 9),
              1e-12);
}

TEST(Equilibrium, TensionIsContinuousAndGrowsWithPassiveStretch) {
  const auto unit = soleus();
  for (const double activation : {0.0, 0.5, 1.0}) {
    double before = equilibrium(unit, 0.25, activation).force_N;
    for (double length = 0.25; length < 0.40; length += 2e-5) {
      const double force = equilibrium(unit, length, activation).force_N;
      // Steepest: the linear tendon, 1.71 / 0.033 F_max per slack length, that is 11 N in 0.02 mm.
      EXPECT_NEAR(force, before, 12) << length << " m, activation " << activation;
      if (activation == 0) {
        EXPECT_GE(force, before - 1e-9);
      }
      before = force;
    }
  }
}

TEST(Equilibrium, SurvivesLengthsFarOutsideTheBody) {
  for (const double length : {1.0, 10.0, 1000.0}) {
    const FiberState s = equilibrium(soleus(), length, 1);
    EXPECT_TRUE(std::isfinite(s.force_N));
    EXPECT_GT(s.force_N, 3000);
  }
  EXPECT_NEAR(longestLength_m(soleus()), 1.6 * 0.044 + 1.03 * 0.28, 1e-15);
}

MusculotendonUnit withCurve(double HillParameters::*field, double value) {
  MusculotendonUnit unit = soleus();
  unit.curves.*field = value;
  return unit;
}

TEST(EditedCurves, AreTheFormulasWithTheirOwnFigures) {
  HillParameters p{.active_width = 0.6, .passive_strain = 0.4, .passive_shape = 4, .tendon_strain = 0.05};
  p.max_velocity_1_s = 6, p.max_lengthening = 1.8;
  const HillCurves curves{p};
  EXPECT_NEAR(curves.active(1.3).value, std::exp(-0.09 / 0.6), 1e-15);
  EXPECT_NEAR(curves.passive(1.4).value, 1, 1e-15);
  EXPECT_NEAR(curves.passive(1.2).value, std::expm1(2) / std::expm1(4), 1e-15);
  EXPECT_NEAR(curves.tendon(1.05).value, 1, 1e-14);
  EXPECT_NEAR(curves.velocity(-6, 1).value, 0, 1e-15);
  EXPECT_NEAR(curves.velocity(1e7, 1).value, 1.8, 1e-4);
  expectSmooth([&](double l) { return curves.active(l); }, 0.2, 2, 5);
  expectSmooth([&](double l) { return curves.passive(l); }, 0.9, 1.7, 100);
  expectSmooth([&](double l) { return curves.tendon(l); }, 0.99, 1.08, 1e5);
  expectSmooth([&](double v) { return curves.velocity(v, 1); }, -8, 5, 100);
}

TEST(EditedCurves, TheDefaultIsThelenBitByBit) {
  const HillCurves curves{HillParameters{}};
  for (double x = 0.3; x < 2; x += 0.01) {
    EXPECT_EQ(curves.active(x).value, activeForceLength(x).value);
    EXPECT_EQ(curves.passive(x).value, passiveForceLength(x).value);
    EXPECT_EQ(curves.tendon(x).value, tendonForceLength(x).value);
  }
}

TEST(EditedCurves, ChangeTheEquilibriumTheRightWay) {
  const double stretched_m = 1.35 * 0.044 + 0.284;
  const double before_N = equilibrium(soleus(), stretched_m, 0).force_N;
  EXPECT_GT(before_N, 0);
  EXPECT_GT(equilibrium(withCurve(&HillParameters::passive_strain, 0.4), stretched_m, 0).force_N, 1.5 * before_N);
  EXPECT_LT(equilibrium(withCurve(&HillParameters::tendon_strain, 0.08), stretched_m, 0).force_N, before_N);
  const FiberState wide = equilibrium(withCurve(&HillParameters::active_width, 0.9), stretched_m, 1);
  EXPECT_GT(wide.active_force_N, equilibrium(soleus(), stretched_m, 1).active_force_N);
}

TEST(EditedCurves, LongestLengthFollowsTheStrains) {
  EXPECT_EQ(longestLength_m(withCurve(&HillParameters::active_width, 0.9)), longestLength_m(soleus()));
  EXPECT_NEAR(longestLength_m(withCurve(&HillParameters::passive_strain, 0.4)), 1.4 * 0.044 + 1.03 * 0.28, 1e-15);
  EXPECT_NEAR(longestLength_m(withCurve(&HillParameters::tendon_strain, 0.066)), 1.6 * 0.044 + 1.06 * 0.28, 1e-15);
}

TEST(EditedCurves, RefusesUnknownNamesAndBadValues) {
  const Musculature muscles{{soleus()}};
  const auto refuses = [&](const CurveEdit& edit) {
    EXPECT_THROW(withCurves(muscles, {&edit, 1}), InputError) << edit.units << " " << edit.field << " " << edit.value;
  };
  refuses({"soleus", "activ_width", 0.5});
  refuses({"soles", "active_width", 0.5});
  refuses({"soleus", "active_width", 0});
  refuses({"soleus", "active_width", std::nan("")});
  refuses({"soleus", "passive_strain", -0.6});
  refuses({"soleus", "max_lengthening", 0.9});
}

}  // namespace
}  // namespace sinew
