#include "core/posture/controllability.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "core/error.h"
#include "core/muscle/hill.h"
#include "core/muscle/load_musculature.h"
#include "tests/support/resources.h"
#include "tests/support/valid_postures.h"

namespace sinew {
namespace {

constexpr double kReached = 0.01;  // share of the wanted torque that may be missing

class Controllability : public testing::Test {
 protected:
  const std::string& nameOf(int coordinate) const {
    return skeleton_.coordinates[static_cast<std::size_t>(coordinate)].name;
  }
  /// "foot_inversion_r at -5 -8 -11 deg": the joint's three clinical angles.
  std::string placeOf(int coordinate, const Posture& posture) const {
    const Joint& joint = skeleton_.joints[static_cast<std::size_t>(skeleton_.coordinates[coordinate].joint)];
    const Eigen::VectorXd clinical = clinicalFromPosture(skeleton_, posture) * 180 / std::numbers::pi;
    std::string text = joint.name + " at";
    for (int i = 0; i < joint.coordinate_count; ++i)
      text += " " + std::to_string(std::lround(clinical[joint.first_coordinate + i]));
    return text + " deg";
  }
  /// Prints each direction that is not reached. @returns how many of the 4,400 are.
  int reachedIn(const std::vector<Posture>& postures) const {
    require(postures.size() == 50, "50 postures");
    std::map<std::string, int> missed;  // by coordinate without side, and direction
    for (const Posture& posture : postures)
      for (const auto& c : controllable(skeleton_, musculature_, posture))
        for (const bool up : {true, false}) {
          const double residual = (up ? c.increasing : c.decreasing).residual;
          if (residual < kReached) continue;
          ++missed[std::string{withoutSide(nameOf(c.coordinate))} + (up ? " +" : " -")];
          if (residual > 0.5)  // the direction that is missing, not one that goes with it
            std::printf("%s %c: %.0f %% missing, %s\n", nameOf(c.coordinate).c_str(), up ? '+' : '-', 100 * residual,
                        placeOf(c.coordinate, posture).c_str());
        }
    int count = 0;
    for (const auto& [direction, times] : missed) {
      std::printf("%s is not reached in %d of 50 postures (both sides counted)\n", direction.c_str(), times);
      count += times;
    }
    std::printf("directions reached: %d of %d\n", kDirections - count, kDirections);
    return kDirections - count;
  }
  static constexpr int kDirections = 50 * 88;

  const Skeleton skeleton_ = loadReferenceSkeleton(test::resourceDir());
  const Musculature musculature_ = loadMusculature(test::resourceDir(), skeleton_);
};

TEST_F(Controllability, EveryCoordinateIsTurnedBothWaysWhenStanding) {
  const Posture standing = zeroPosture(skeleton_);
  const auto controls = controllability(skeleton_, musculature_, standing);
  const auto torque = isometricTorque(musculature_, evaluatePosture(skeleton_, musculature_, standing));
  ASSERT_EQ(controls.size(), 44u);  // 50 less the free root, which only outer forces move
  for (const auto& c : controls) {
    const std::string& name = nameOf(c.coordinate);
    EXPECT_LT(c.increasing.residual, kReached) << name;
    EXPECT_LT(c.decreasing.residual, kReached) << name;
    EXPECT_GT(c.increasing.strength_Nm, 1) << name;
    EXPECT_GT(c.decreasing.strength_Nm, 1) << name;
    // Alone about one coordinate there can be no more than all units that turn that way give.
    EXPECT_LE(c.increasing.strength_Nm, torque.increasing_Nm[c.coordinate]) << name;
    EXPECT_LE(c.decreasing.strength_Nm, -torque.decreasing_Nm[c.coordinate]) << name;
    if (!name.ends_with("_l"))
      std::printf("%-29s + %6.1f (all agonists %6.1f)   - %6.1f (%6.1f) N m\n", name.c_str(),
                  c.increasing.strength_Nm, torque.increasing_Nm[c.coordinate], c.decreasing.strength_Nm,
                  -torque.decreasing_Nm[c.coordinate]);
  }
}

/// To the very ends of the passive range: the postures are those of the pose set.
TEST_F(Controllability, EveryCoordinateIsTurnedBothWaysInFiftyValidPostures) {
  EXPECT_EQ(reachedIn(test::validPostures(skeleton_, musculature_, 50, 2026)), kDirections);
}

/// The head nods forwards by longus capitis only.
TEST_F(Controllability, SaysWhatIsMissing) {
  Musculature without;
  for (const auto& unit : musculature_.units)
    if (!unit.name.starts_with("longus_capitis")) without.units.push_back(unit);
  const int nod = skeleton_.coordinateIndex("head_flexion");
  for (const auto& c : controllability(skeleton_, without, zeroPosture(skeleton_)))
    if (c.coordinate == nod) {
      EXPECT_NEAR(c.increasing.residual, 1, 1e-9);
      EXPECT_LT(c.increasing.strength_Nm, 1e-6);
      EXPECT_LT(c.decreasing.residual, kReached);
    }
}

/// Two units that span the knee alone: strength is arm times the force that activation adds to what is there
/// passively.
TEST_F(Controllability, StrengthOfOneHingeIsForceTimesArm) {
  const Posture q = postureFromDegrees(skeleton_, {{"knee_flexion_r", 40}});
  Musculature pair;
  for (const char* name : {"biceps_femoris_short_head_r", "vastus_intermedius_medial_r"})
    pair.units.push_back(musculature_.unit(name));
  const int knee = skeleton_.coordinateIndex("knee_flexion_r");
  const PostureEvaluation e = evaluatePosture(skeleton_, pair, q);
  const auto torqueOf = [&](int i) {
    const double full_N = equilibrium(pair.units[static_cast<std::size_t>(i)], e.length_m[i], 1).force_N;
    return std::abs(e.moment_arm_m(i, knee)) * (full_N - e.passive_force_N[i]);
  };
  for (const auto& c : controllability(skeleton_, pair, q)) {
    if (c.coordinate != knee) continue;
    EXPECT_LT(c.increasing.residual, 1e-12);
    EXPECT_NEAR(c.increasing.strength_Nm, torqueOf(0), 1e-6);
    EXPECT_NEAR(c.decreasing.strength_Nm, torqueOf(1), 1e-6);
  }
}

}  // namespace
}  // namespace sinew
