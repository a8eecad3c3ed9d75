#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/angle.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/fit/fit_skeleton.h"
#include "core/skeleton/shape/population.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

class BoneFigures : public testing::Test {
 protected:
  double figure(const std::string& quantity, const std::string& side = "") const {
    for (const auto& f : boneFigures(skeleton, shape, postureFromDegrees(skeleton, posture_deg)))
      if (f.quantity == quantity && f.side == side) return f.value;
    throw std::runtime_error{"no figure " + quantity + " " + side};
  }

  Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  ShapeParameters shape;
  std::map<std::string, double> posture_deg;
};

TEST_F(BoneFigures, TheReferenceHasThePublishedDimensions) {
  for (const char* side : {"r", "l"}) {
    EXPECT_NEAR(figure("femur_length", side), 422, 1e-9);  // de Leva: hip to knee centre
    EXPECT_NEAR(figure("tibia_length", side), 430, 1e-9);
    EXPECT_NEAR(figure("leg_length", side), 852, 1e-9);
    EXPECT_NEAR(figure("hka", side), 0, 1e-9);
    EXPECT_NEAR(figure("knee_flexion", side), 0, 1e-9);
    EXPECT_NEAR(figure("neck_shaft_angle", side), 127, 1.5);  // 126-128 deg
    EXPECT_NEAR(figure("femoral_torsion", side), 12, 1);      // 12 +- 7 deg
    EXPECT_NEAR(figure("tibial_torsion", side), 25, 2.5);     // 23-30 deg
  }
  EXPECT_NEAR(figure("pelvic_width"), 172,
              1e-9);                          // Bell 1990: 0.36 of the 240 mm between the iliac spines, each side
  EXPECT_NEAR(figure("pelvic_tilt"), 13, 2);  // Legaye 1998
  EXPECT_NEAR(figure("pelvic_obliquity"), 0, 1e-9);
  EXPECT_NEAR(figure("leg_length_difference"), 0, 1e-9);
}

TEST_F(BoneFigures, TorsionAndVarusParametersAddToTheirAngles) {
  const double torsion = figure("femoral_torsion", "r"), tibia = figure("tibial_torsion", "l");
  shape.sides[0].femur.torsion_rad = -20 * kRadPerDeg;  // distal end turned inwards: more anteversion
  shape.sides[1].tibia.torsion_rad = 10 * kRadPerDeg;   // distal end turned outwards: more external torsion
  shape.sides[1].femur.varus_rad = 7 * kRadPerDeg;
  EXPECT_NEAR(std::abs(figure("femoral_torsion", "r") - torsion), 20, 0.2);
  EXPECT_NEAR(figure("tibial_torsion", "l") - tibia, 10, 0.1);
  EXPECT_NEAR(figure("hka", "l"), 7, 1e-6);
  // Varus is read in the frontal plane of the condyles, which torsion turns away from the bend of the shaft.
  shape.sides[0].femur.varus_rad = -4 * kRadPerDeg;
  EXPECT_NEAR(figure("hka", "r"), -4 * std::cos(20 * kRadPerDeg), 0.01);
}

TEST_F(BoneFigures, NeckShaftAngleGrowsWithValgus) {
  const double before = figure("neck_shaft_angle", "r");
  shape.sides[0].femur.neck_shaft_rad = 8 * kRadPerDeg;
  EXPECT_GT(figure("neck_shaft_angle", "r") - before, 4);
  EXPECT_NEAR(figure("neck_shaft_angle", "l"), before, 1e-9);
}

TEST_F(BoneFigures, LengthsFollowElongation) {
  shape.sides[0].femur.elongation = 1.1;
  shape.sides[1].tibia.elongation = 0.95;
  EXPECT_NEAR(figure("femur_length", "r"), 1.1 * 422, 1e-6);
  EXPECT_NEAR(figure("tibia_length", "l"), 0.95 * 430, 1e-6);
  EXPECT_NEAR(figure("leg_length_difference"), 0.1 * 422 + 0.05 * 430, 1e-6);
  shape.pelvis_width = 1.2;
  EXPECT_NEAR(figure("pelvic_width"), 1.2 * 172, 1e-6);
}

TEST_F(BoneFigures, ReadThePostureButNotTheOtherWayRound) {
  posture_deg = {{"knee_flexion_r", 35}, {"knee_flexion_l", 5}, {"hip_flexion_r", 40}, {"hip_adduction_l", -12}};
  shape.sides[0].femur.varus_rad = 5 * kRadPerDeg;
  EXPECT_NEAR(figure("knee_flexion", "r"), 35, 1e-6);
  EXPECT_NEAR(figure("knee_flexion", "l"), 5, 1e-6);
  EXPECT_NEAR(figure("hka", "r"), 5, 1e-6);  // a bent knee does not look like varus
  EXPECT_NEAR(figure("hka", "l"), 0, 1e-6);
  EXPECT_NEAR(figure("leg_length_difference"), 0, 1e-9);
}

TEST_F(BoneFigures, PelvicAnglesHaveTheirSigns) {
  const double tilt = figure("pelvic_tilt");
  // World: X forward, Y up, Z right. A turn about +X lowers the right side, a turn about +Z tips the pelvis backward.
  Posture q = zeroPosture(skeleton);
  q.segment<3>(3) = Eigen::Vector3d{4 * kRadPerDeg, 0, 0};
  const auto of = [&](const char* quantity) {
    for (const auto& f : boneFigures(skeleton, shape, q))
      if (f.quantity == quantity) return f.value;
    return 1e9;
  };
  EXPECT_NEAR(of("pelvic_obliquity"), -4, 1e-6);
  q.segment<3>(3) = Eigen::Vector3d{0, 0, 6 * kRadPerDeg};
  EXPECT_NEAR(of("pelvic_tilt"), tilt + 6, 1e-6);
  q.segment<3>(3) = Eigen::Vector3d{0, 50 * kRadPerDeg, 0};  // a turned patient keeps both
  EXPECT_NEAR(of("pelvic_tilt"), tilt, 1e-6);
  EXPECT_NEAR(of("pelvic_obliquity"), 0, 1e-6);
}

TEST_F(BoneFigures, AMirroredBodyHasMirroredFigures) {
  std::mt19937_64 random{5};
  shape = drawShape(loadShapePriors(test::resourceDir()), random);
  const double torsion_r = figure("femoral_torsion", "r"), nsa_l = figure("neck_shaft_angle", "l"),
               tibia_l = figure("tibial_torsion", "l"), difference = figure("leg_length_difference");
  std::swap(shape.sides[0], shape.sides[1]);
  EXPECT_NEAR(figure("femoral_torsion", "l"), torsion_r, 1e-9);
  EXPECT_NEAR(figure("neck_shaft_angle", "r"), nsa_l, 1e-9);
  EXPECT_NEAR(figure("tibial_torsion", "r"), tibia_l, 1e-9);
  EXPECT_NEAR(figure("leg_length_difference"), -difference, 1e-9);
}

}  // namespace
}  // namespace sinew
