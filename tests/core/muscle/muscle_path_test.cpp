#include "core/muscle/muscle_path.h"

#include <gtest/gtest.h>

#include "core/muscle/load_musculature.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const Skeleton& skeleton() {
  static const Skeleton loaded = loadReferenceSkeleton(test::resourceDir());
  return loaded;
}
const Musculature& musculature() {
  static const Musculature loaded = loadMusculature(test::resourceDir(), skeleton());
  return loaded;
}

TEST(MusclePath, LengthIsThatOfThePolylineThroughThePoints) {
  const auto X_WB = segmentPoses(skeleton(), zeroPosture(skeleton()));
  for (const auto& unit : musculature().units) {
    const auto points = pathPoints(unit, X_WB);
    double length = 0;
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    EXPECT_NEAR(pathLength(unit, X_WB), length, 1e-15);
  }
}

TEST(MusclePath, ABlendedPointLiesBetweenItsAnchors) {
  MusculotendonUnit unit;
  unit.path = {{PathPointRole::Origin, {{0, 0.25, {1, 0, 0}}, {1, 0.75, {0, 1, 0}}}, "", ""},
               {PathPointRole::Insertion, {{0, 1, {0, 0, 0}}}, "", ""}};
  std::vector<RigidTransform> X_WB(2, RigidTransform::Identity());
  X_WB[1].translation() = Eigen::Vector3d{0, 0, 4};
  EXPECT_TRUE(pathPoints(unit, X_WB)[0].isApprox(Eigen::Vector3d{0.25, 0.75, 3}));
  EXPECT_NEAR(pathLength(unit, X_WB), std::sqrt(0.0625 + 0.5625 + 9), 1e-15);
}

TEST(MusclePath, PassiveLoadsIgnoreWhereTheBodyStands) {
  std::mt19937_64 random{13};
  const Kinematics k =
      kinematics(skeleton(), postureFromClinical(skeleton(), test::randomClinical(skeleton(), random)));
  for (const auto& unit : musculature().units)
    EXPECT_LT(lengthGradient(unit, k).head(6).cwiseAbs().maxCoeff(), 1e-12) << unit.name;  // root: no net pull
}

TEST(MusclePath, LeftIsTheMirrorImageOfRight) {
  std::mt19937_64 random{17};
  const std::size_t half = musculature().units.size() / 2;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd clinical = test::randomClinical(skeleton(), random);
    const auto X_right = segmentPoses(skeleton(), postureFromClinical(skeleton(), clinical));
    const auto X_left =
        segmentPoses(skeleton(), postureFromClinical(skeleton(), test::mirroredClinical(skeleton(), clinical)));
    for (std::size_t i = 0; i < half; ++i) {
      const auto& right = musculature().units[i];
      const auto& left = musculature().units[half + i];
      ASSERT_EQ(withoutSide(left.name), withoutSide(right.name));
      EXPECT_NEAR(pathLength(right, X_right), pathLength(left, X_left), 1e-9) << right.name;
      EXPECT_NEAR(pathLength(left, X_right), pathLength(right, X_left), 1e-9) << right.name;
    }
  }
}

TEST(MusclePath, RevoluteMomentArmIsTheLeverOfTheLineOfAction) {
  // Vastus-like line over a hinge: the paper's moment arm, force x lever about the axis, equals -dl/dq.
  const Posture q = postureFromDegrees(skeleton(), {{"knee_flexion_r", 40}, {"hip_flexion_r", 20}});
  const Kinematics clinical = clinicalKinematics(skeleton(), q);
  const int knee = skeleton().coordinateIndex("knee_flexion_r");
  const Joint& joint = skeleton().joints[skeleton().jointIndex("knee_r")];
  const RigidTransform X_WJ = clinical.X_WB[joint.parent] * joint.X_PJ;
  const Eigen::Vector3d axis_W = X_WJ.linear() * skeleton().coordinates[knee].axis;
  for (const auto* name : {"biceps_femoris_short_head_r", "biceps_femoris_long_head_r"}) {  // last segment crosses
    const auto& unit = musculature().unit(name);
    const auto points = pathPoints(unit, clinical.X_WB);
    const Eigen::Vector3d pull = (points[points.size() - 2] - points.back()).normalized();
    const double lever = axis_W.dot((points.back() - X_WJ.translation()).cross(pull));
    EXPECT_NEAR(momentArms(unit, clinical)[knee], lever, 1e-9) << name;
  }
}

}  // namespace
}  // namespace sinew
