#include "core/posture/evaluate.h"

#include <gmock/gmock.h>

#include <numbers>

#include "core/muscle/hill.h"
#include "core/muscle/load_musculature.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

class EvaluatePosture : public testing::Test {
 protected:
  PostureEvaluation at(const std::map<std::string, double>& degrees) const {
    return evaluatePosture(skeleton_, musculature_, postureFromDegrees(skeleton_, degrees));
  }
  const Skeleton skeleton_ = loadReferenceSkeleton(test::resourceDir());
  const Musculature musculature_ = loadMusculature(test::resourceDir(), skeleton_);
};

TEST_F(EvaluatePosture, StandingIsValidAndNearlyFree) {
  const auto e = at({});
  EXPECT_TRUE(e.valid);
  EXPECT_GT(e.margins.front().margin_m, 0);
  EXPECT_EQ(e.margins.size(), musculature_.units.size());
  for (std::size_t i = 1; i < e.margins.size(); ++i) EXPECT_LE(e.margins[i - 1].margin_m, e.margins[i].margin_m);
  for (const char* name : {"hip_flexion_r", "knee_flexion_r", "ankle_dorsiflexion_r", "elbow_flexion_r"})
    EXPECT_LT(std::abs(e.passive_torque[skeleton_.coordinateIndex(name)]), 6) << name;  // a tenth of an exam's torque
}

TEST_F(EvaluatePosture, IsometricTorqueIsForceTimesArmOfThoseWhoTurnThatWay) {
  const auto e = at({{"hip_flexion_r", 40}, {"knee_flexion_r", 60}});
  const auto torque = isometricTorque(musculature_, e);
  const int knee = skeleton_.coordinateIndex("knee_flexion_r");
  double flexing = 0, extending = 0;
  for (Eigen::Index i = 0; i < e.length_m.size(); ++i) {
    const double arm_m = e.moment_arm_m(i, knee);
    (arm_m > 0 ? flexing : extending) +=
        arm_m * equilibrium(musculature_.units[static_cast<std::size_t>(i)], e.length_m[i], 1).force_N;
  }
  EXPECT_NEAR(torque.increasing_Nm[knee], flexing, 1e-9);
  EXPECT_NEAR(torque.decreasing_Nm[knee], extending, 1e-9);
  EXPECT_GT(flexing, 0);
  EXPECT_LT(extending, 0);
}

TEST_F(EvaluatePosture, TorqueIsForceTimesArm) {
  const auto e = at({{"hip_flexion_r", 90}, {"knee_flexion_r", 20}});
  const int knee = skeleton_.coordinateIndex("knee_flexion_r");
  double sum = 0;
  for (Eigen::Index i = 0; i < e.length_m.size(); ++i) sum += e.passive_force_N[i] * e.moment_arm_m(i, knee);
  EXPECT_NEAR(e.passive_torque[knee], sum, 1e-9);
  EXPECT_GT(sum, 0);  // hamstrings bend the knee
  EXPECT_NEAR(e.passive_torque[skeleton_.coordinateIndex("knee_flexion_l")], 0, 1);
}

TEST_F(EvaluatePosture, SaysWhichMuscleAndWhichCoordinateGoTooFar) {
  const auto toe_touch = at({{"hip_flexion_r", 140}});
  EXPECT_FALSE(toe_touch.valid);
  const std::string worst = musculature_.units[static_cast<std::size_t>(toe_touch.margins.front().unit)].name;
  EXPECT_THAT(worst, testing::AnyOf("semimembranosus_r", "biceps_femoris_long_head_r", "semitendinosus_r"));
  EXPECT_LT(toe_touch.margins.front().margin_m, 0);
  EXPECT_TRUE(toe_touch.coordinates_beyond_envelope.empty());
  const auto bent = at({{"knee_flexion_l", 170}});
  EXPECT_FALSE(bent.valid);
  EXPECT_THAT(bent.coordinates_beyond_envelope, testing::ElementsAre("knee_flexion_l"));
}

TEST_F(EvaluatePosture, PassiveForcesDoNoWorkAroundAClosedLoop) {
  const int hip = skeleton_.coordinateIndex("hip_flexion_r"), knee = skeleton_.coordinateIndex("knee_flexion_r");
  constexpr int kSteps = 200;
  double work_J = 0, moved_J = 0;
  for (int i = 0; i < kSteps; ++i) {  // the trapezoid rule is exact to machine precision on smooth periodic functions
    const double t = 2 * std::numbers::pi * i / kSteps;
    const auto e = at({{"hip_flexion_r", 80 + 20 * std::cos(t)}, {"knee_flexion_r", 45 + 20 * std::sin(t)}});
    const double rate = 20 * std::numbers::pi / 180 * 2 * std::numbers::pi / kSteps;
    const double step = -e.passive_torque[hip] * std::sin(t) * rate + e.passive_torque[knee] * std::cos(t) * rate;
    work_J += step;
    moved_J += std::abs(step);
  }
  EXPECT_GT(moved_J, 10);
  EXPECT_NEAR(work_J, 0, 1e-4 * moved_J);  // the curves are C1, not smoother: the rule is good to about 1e-5
}

TEST_F(EvaluatePosture, MotionCurveIsConsistentWithItself) {
  const auto motions = loadJointMotions(test::resourceDir(), skeleton_);
  const auto& unit = musculature_.unit("gastrocnemius_medial_r");
  const auto curve = motionCurve(skeleton_, unit, findMotion(motions, "ankle_dorsiflexion_r"), 121);
  ASSERT_EQ(curve.theta.size(), 121u);
  EXPECT_EQ(curve.theta.front(), 0);
  EXPECT_EQ(curve.theta.back(), 1);
  EXPECT_DOUBLE_EQ(curve.angle_deg.front(), -40);
  EXPECT_DOUBLE_EQ(curve.angle_deg.back(), 20);
  for (std::size_t i = 1; i + 1 < curve.theta.size(); ++i) {
    const double step = (curve.angle_deg[i + 1] - curve.angle_deg[i - 1]) * std::numbers::pi / 180;
    // Central differences over half a degree: relative error about h^2 / 6 = 1e-5.
    EXPECT_NEAR(curve.moment_arm_m[i], -(curve.length_m[i + 1] - curve.length_m[i - 1]) / step, 2e-6);
    EXPECT_GT(curve.length_m[i], curve.length_m[i - 1]);  // dorsiflexion lengthens the calf
    EXPECT_GE(curve.passive_force_N[i], curve.passive_force_N[i - 1]);
    const FiberState full = equilibrium(unit, curve.length_m[i], 1);
    EXPECT_NEAR(curve.full_torque_Nm[i], full.force_N * curve.moment_arm_m[i], 1e-9);
    EXPECT_LE(curve.active_force_N[i], full.force_N);
  }
}

}  // namespace
}  // namespace sinew
