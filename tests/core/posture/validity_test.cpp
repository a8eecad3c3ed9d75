#include "core/posture/validity.h"

#include <gmock/gmock.h>

#include "core/model/model.h"
#include "core/model/rom_preset.h"
#include "core/muscle/hill.h"
#include "core/muscle/load_musculature.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

class ValidityTest : public testing::Test {
 protected:
  ValidityTest() { setStops(skeleton_, loadRomPreset(test::resourceDir(), kDefaultPreset, skeleton_)); }
  Validity at(const std::map<std::string, double>& degrees) const {
    return validity(skeleton_, muscles_, postureFromDegrees(skeleton_, degrees));
  }
  std::string first(const Validity& v) const { return nameOf(v.first, skeleton_, muscles_); }

  Skeleton skeleton_ = loadReferenceSkeleton(test::resourceDir());
  Musculature muscles_ = loadMusculature(test::resourceDir(), skeleton_);
};

TEST_F(ValidityTest, StandingHoldsAndNamesTheNextToFail) {
  const Validity v = at({});
  EXPECT_TRUE(v.valid);
  EXPECT_TRUE(v.violated.empty());
  EXPECT_GE(v.first.relative, -1e-9);
  EXPECT_EQ(constraintMargins(skeleton_, muscles_, zeroPosture(skeleton_)).size(),
            muscles_.units.size() + static_cast<std::size_t>(skeleton_.coordinateCount()) - 6);
}

TEST_F(ValidityTest, MuscleMarginIsLongestLengthMinusPath) {
  const Posture q = postureFromDegrees(skeleton_, {{"hip_flexion_r", 60}, {"knee_flexion_r", 10}});
  const auto X_WB = segmentPoses(skeleton_, q);
  const auto margins = constraintMargins(skeleton_, muscles_, q);
  for (std::size_t i = 0; i < muscles_.units.size(); ++i) {
    EXPECT_EQ(margins[i].kind, ConstraintKind::MuscleLength);
    EXPECT_DOUBLE_EQ(margins[i].margin, longestLength_m(muscles_.units[i]) - pathLength(muscles_.units[i], X_WB));
  }
}

TEST_F(ValidityTest, SaysWhatFailsFirstAndByHowMuch) {
  const Validity hurdler = at({{"hip_flexion_r", 118}});  // inside the stops, beyond straight-leg hamstrings
  EXPECT_FALSE(hurdler.valid);
  EXPECT_THAT(first(hurdler), testing::AnyOf("semimembranosus_r", "semitendinosus_r", "biceps_femoris_long_head_r"));
  EXPECT_LT(hurdler.first.margin, 0);
  for (std::size_t i = 1; i < hurdler.violated.size(); ++i)
    EXPECT_LE(hurdler.violated[i - 1].relative, hurdler.violated[i].relative);

  const Coordinate& elbow = skeleton_.coordinates[skeleton_.coordinateIndex("elbow_flexion_l")];
  const double beyond_rad = 0.1;
  Posture q = zeroPosture(skeleton_);
  q[skeleton_.coordinateIndex("elbow_flexion_l")] = elbow.stop_min_rad - beyond_rad;
  const Validity v = validity(skeleton_, muscles_, q);
  EXPECT_FALSE(v.valid);
  EXPECT_EQ(first(v), "elbow_flexion_l (stop, min)");
  EXPECT_NEAR(v.first.margin, -beyond_rad, 1e-12);
}

TEST_F(ValidityTest, AStopItselfIsStillValid) {
  for (const char* name : {"hip_flexion_r", "knee_flexion_r", "elbow_flexion_r", "lumbar_rotation"}) {
    const int i = skeleton_.coordinateIndex(name);
    Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton_.coordinateCount());
    clinical[i] = skeleton_.coordinates[i].stop_min_rad;
    for (const auto& m : stopMargins(skeleton_, postureFromClinical(skeleton_, clinical)))
      EXPECT_TRUE(m.holds()) << skeleton_.coordinates[m.index].name;
  }
}

/// Abduction by 110: the usual reading is 70 with the other two angles turned by half a turn.
TEST_F(ValidityTest, AnArmAboveTheHorizontalIsInsideItsStops) {
  const Posture q = postureFromDegrees(skeleton_, {{"shoulder_adduction_r", -110}});
  for (const auto& m : stopMargins(skeleton_, q)) {
    EXPECT_TRUE(m.holds()) << skeleton_.coordinates[m.index].name;
    if (skeleton_.coordinates[m.index].name == "shoulder_adduction_r") {
      const double stop_rad = skeleton_.coordinates[m.index].stop_min_rad;
      EXPECT_NEAR(m.margin, -110 * 3.14159265358979323846 / 180 - stop_rad, 1e-9);
    }
  }
  const Posture beyond = postureFromDegrees(skeleton_, {{"shoulder_adduction_r", -150}});
  EXPECT_FALSE(validity(skeleton_, muscles_, beyond).valid);
}

TEST(BallAngles, BothReadingsGiveTheSameOrientation) {
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  for (const Joint& joint : skeleton.joints) {
    if (joint.type != JointType::Ball) continue;
    const Eigen::Vector3d v{0.3, -0.8, 0.5};
    for (const Eigen::Vector3d& angles : clinicalReadings(skeleton, joint, rotationFromVector<double>(v))) {
      Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
      clinical.segment<3>(joint.first_coordinate) = angles;
      const Eigen::Vector3d back = postureFromClinical(skeleton, clinical).segment<3>(joint.first_coordinate);
      EXPECT_LT((back - v).norm(), 1e-9) << joint.name;
    }
  }
}

}  // namespace
}  // namespace sinew
