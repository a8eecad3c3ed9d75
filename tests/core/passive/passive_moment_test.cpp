#include "core/passive/passive_moment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sinew {
namespace {

/// Anderson 1999 as used by KU Leuven: hip flexion [-2.44 5.05 1.51 -21.88], limits [-0.698 1.81].
constexpr PassiveMoment kHipFlexion{2.44, 5.05, 1.81, 1.51, 21.88, -0.698};

TEST(PassiveMoment, HasThePublishedValues) {
  for (const double q : {-0.9, -0.7, -0.3, 0.0, 1.0, 1.9, 2.3}) {
    const double published = -2.44 * std::exp(5.05 * (q - 1.81)) + 1.51 * std::exp(-21.88 * (q + 0.698));
    EXPECT_NEAR(passiveMoment_Nm(kHipFlexion, q), published, 1e-12 * (1 + std::abs(published))) << q;
  }
}

TEST(PassiveMoment, IsMinusTheGradientOfItsEnergyAndStiffnessMinusItsOwn) {
  constexpr double h = 1e-6;
  for (double q = -2; q <= 4; q += 0.0371) {  // far beyond both ends: the straight parts too
    const double gradient = (passiveEnergy_J(kHipFlexion, q + h) - passiveEnergy_J(kHipFlexion, q - h)) / (2 * h);
    const double moment = passiveMoment_Nm(kHipFlexion, q);
    EXPECT_NEAR(moment, -gradient, 1e-6 * (1 + std::abs(moment))) << q;
    const double slope = (passiveMoment_Nm(kHipFlexion, q + h) - passiveMoment_Nm(kHipFlexion, q - h)) / (2 * h);
    const double stiffness = passiveStiffness_Nm_rad(kHipFlexion, q);
    EXPECT_NEAR(stiffness, -slope, 1e-5 * (1 + stiffness)) << q;
    EXPECT_GE(passiveEnergy_J(kHipFlexion, q), 0);
  }
}

TEST(PassiveMoment, FallsAllTheWayAndStaysFinite) {
  double before = std::numeric_limits<double>::infinity();
  for (double q = -50; q <= 50; q += 0.01) {
    const double moment = passiveMoment_Nm(kHipFlexion, q);
    ASSERT_TRUE(std::isfinite(moment) && std::isfinite(passiveEnergy_J(kHipFlexion, q))) << q;
    ASSERT_LE(moment, before) << q;  // equal only where both terms are below rounding
    before = moment;
  }
  EXPECT_GT(passiveMoment_Nm(kHipFlexion, -50), passiveMoment_Nm(kHipFlexion, -40));
}

TEST(PassiveMoment, TellsWhereAnEndReachesAMoment) {
  for (const double moment : {0.1, 1.51, 50.0, 1e6}) {  // the last lies on the straight part
    const double lower = lowerAngleAt_rad(kHipFlexion, moment), upper = upperAngleAt_rad(kHipFlexion, moment);
    PassiveMoment one_end = kHipFlexion;
    one_end.upper_Nm = 0;
    EXPECT_NEAR(passiveMoment_Nm(one_end, lower), moment, 1e-9 * moment);
    one_end = kHipFlexion;
    one_end.lower_Nm = 0;
    EXPECT_NEAR(passiveMoment_Nm(one_end, upper), -moment, 1e-9 * moment);
  }
  EXPECT_EQ(upperAngleAt_rad({}, 50), std::numeric_limits<double>::infinity());
  EXPECT_EQ(lowerAngleAt_rad({}, 50), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(passiveMoment_Nm({}, 3), 0);
}

}  // namespace
}  // namespace sinew
