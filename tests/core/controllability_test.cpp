#include "core/muscle/controllability.h"

#include <gtest/gtest.h>

#include <chrono>

#include "core/muscle/load_musculature.h"
#include "tests/support/resources.h"
#include "tests/support/valid_postures.h"

namespace sinew {
namespace {

constexpr double kReached = 0.01;  // share of the wanted torque that may be missing

class Controllability : public testing::Test {
 protected:
  void expectBothWays(const std::vector<CoordinateControl>& controls, const std::string& where) {
    ASSERT_EQ(controls.size(), 44u);  // 50 less the free root
    for (const auto& control : controls) {
      const std::string& name = skeleton_.coordinates[static_cast<std::size_t>(control.coordinate)].name;
      EXPECT_LT(control.increasing.residual, kReached) << name << " + " << where;
      EXPECT_LT(control.decreasing.residual, kReached) << name << " - " << where;
    }
  }
  const Skeleton skeleton_ = loadReferenceSkeleton(test::resourceDir());
  const Musculature musculature_ = loadMusculature(test::resourceDir(), skeleton_);
};

TEST_F(Controllability, EveryCoordinateIsTurnedBothWaysWhenStanding) {
  const auto controls = controllability(skeleton_, musculature_, zeroPosture(skeleton_));
  expectBothWays(controls, "standing");
  const auto torque = isometricTorque(musculature_, evaluatePosture(skeleton_, musculature_, zeroPosture(skeleton_)));
  for (const auto& c : controls) {
    const std::string& name = skeleton_.coordinates[static_cast<std::size_t>(c.coordinate)].name;
    std::printf("%-30s + %8.2f (all %8.2f)   - %8.2f (all %8.2f) N m\n", name.c_str(), c.increasing.strength_Nm,
                torque.increasing_Nm[c.coordinate], c.decreasing.strength_Nm, -torque.decreasing_Nm[c.coordinate]);
    // Alone about one coordinate can be no more than all that turn that way give.
    EXPECT_GT(c.increasing.strength_Nm, 0) << name;
    EXPECT_GT(c.decreasing.strength_Nm, 0) << name;
    EXPECT_LE(c.increasing.strength_Nm, torque.increasing_Nm[c.coordinate]) << name;
    EXPECT_LE(c.decreasing.strength_Nm, -torque.decreasing_Nm[c.coordinate]) << name;
  }
}

TEST_F(Controllability, EveryCoordinateIsTurnedBothWaysInFiftyValidPostures) {
  const auto postures = test::validPostures(skeleton_, musculature_, 50, 2026);
  ASSERT_EQ(postures.size(), 50u);
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < postures.size(); ++i)
    expectBothWays(controllable(skeleton_, musculature_, postures[i]), "posture " + std::to_string(i));
  std::printf("%g s\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

/// A finger of one hinge: what is reached, and how strongly, is known beforehand.
TEST_F(Controllability, FindsWhatIsMissing) {
  Musculature flexors_only;
  for (const auto& unit : musculature_.units)
    if (!unit.name.starts_with("longus_capitis")) flexors_only.units.push_back(unit);
  const auto controls = controllability(skeleton_, flexors_only, zeroPosture(skeleton_));
  const int nod = skeleton_.coordinateIndex("head_flexion");
  for (const auto& c : controls)
    if (c.coordinate == nod) {
      EXPECT_NEAR(c.increasing.residual, 1, 1e-9);
      EXPECT_LT(c.increasing.strength_Nm, 1e-6);
      EXPECT_LT(c.decreasing.residual, kReached);
    }
}

}  // namespace
}  // namespace sinew
