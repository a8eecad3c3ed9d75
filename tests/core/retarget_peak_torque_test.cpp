#include <gtest/gtest.h>

#include <cmath>

#include "core/muscle/hill.h"
#include "core/retarget/peak_torque.h"
#include "core/retarget/ratio_force_internal.h"
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
  double fiber = 0;
  force.setFactor(1.1);
  const CurveValue at = force.at(length_m, fiber);
  constexpr double kStep = 1e-5;
  force.setFactor(1.1 + kStep);
  const double more = force.at(length_m, fiber).value;
  force.setFactor(1.1 - kStep);
  const double less = force.at(length_m, fiber).value;
  EXPECT_NEAR(at.slope, (more - less) / (2 * kStep), 1e-5 * unit.max_isometric_force_N);
}

}  // namespace
}  // namespace sinew
