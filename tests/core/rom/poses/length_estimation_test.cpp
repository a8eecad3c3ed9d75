#include "core/rom/poses/length_estimation.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const Skeleton& skeleton() {
  static const Skeleton loaded = loadReferenceSkeleton(test::resourceDir());
  return loaded;
}

/// Popliteus-like unit that the knee alone stretches.
MusculotendonUnit kneeUnit(double fiber_m, double tendon_m) {
  MusculotendonUnit unit;
  unit.name = "test_r";
  unit.max_isometric_force_N = 500;
  unit.optimal_fiber_length_m = fiber_m;
  unit.tendon_slack_length_m = tendon_m;
  const int femur = skeleton().segmentIndex("femur_r"), tibia = skeleton().segmentIndex("tibia_r");
  unit.path = {{PathPointRole::Origin, {{femur, 1, {-0.03, -0.3, 0}}}, "", ""},
               {PathPointRole::Insertion, {{tibia, 1, {-0.03, -0.1, 0}}}, "", ""}};
  return unit;
}

PathLimits limitsOver(const Musculature& muscles, const std::vector<Posture>& postures) {
  return longestPaths(skeleton(), muscles, [&](const PoseVisitor& visit) {
    for (const Posture& q : postures) visit(q);  // blocks of one
  });
}

TEST(LongestPaths, AreTheExtremesOverAllBlocks) {
  const Musculature muscles{{kneeUnit(0.1, 0.05)}};
  std::vector<Posture> postures;
  for (const double deg : {60.0, 0.0, 120.0})
    postures.push_back(postureFromDegrees(skeleton(), {{"knee_flexion_r", deg}}));
  const PathLimits limits = limitsOver(muscles, postures);
  EXPECT_NEAR(limits.longest_m[0], pathLength(muscles.units[0], segmentPoses(skeleton(), postures[1])), 1e-12);
  EXPECT_NEAR(limits.shortest_m[0], pathLength(muscles.units[0], segmentPoses(skeleton(), postures[2])), 1e-12);
}

TEST(LengthEstimation, LongestLengthIsTheLongestPath) {
  const Musculature muscles{{kneeUnit(0.1, 0.05)}};
  const std::vector<Posture> bent{postureFromDegrees(skeleton(), {{"knee_flexion_r", 60}}),
                                  postureFromDegrees(skeleton(), {{"knee_flexion_r", 30}}),
                                  postureFromDegrees(skeleton(), {{"knee_flexion_r", 90}})};
  const std::vector<Posture> resting{postureFromDegrees(skeleton(), {{"knee_flexion_r", 120}})};
  const auto estimate =
      estimateLengths(skeleton(), muscles, limitsOver(muscles, bent), resting, {.smallest_ratio = 1}).front();
  const double longest = pathLength(muscles.units[0], segmentPoses(skeleton(), bent[1]));
  EXPECT_NEAR(estimate.longest_path_m, longest, 1e-12);
  EXPECT_FALSE(estimate.relaxed);
  EXPECT_NEAR(1.6 * estimate.optimal_fiber_length_m + 1.03 * estimate.tendon_slack_length_m, longest, 1e-12);
  EXPECT_NEAR(estimate.tendon_slack_length_m / estimate.optimal_fiber_length_m, 0.5, 1e-12);
}

TEST(LengthEstimation, AUnitThatWouldPullAtRestIsLengthenedJustEnough) {
  const Musculature muscles{{kneeUnit(0.1, 0.05)}};
  const std::vector<Posture> straight{zeroPosture(skeleton())};
  const auto estimate = estimateLengths(skeleton(), muscles, limitsOver(muscles, straight), straight).front();
  EXPECT_TRUE(estimate.relaxed);
  const MusculotendonUnit sized = withLengths(muscles, {estimate}).units[0];
  EXPECT_NEAR(equilibrium(sized, estimate.longest_path_m, 0).force_N, 0.008 * 500, 1e-3);
  EXPECT_LT(estimate.resting_normalized_fiber, 1.1);
}

TEST(LengthEstimation, AFiberThatWouldStandTooShortTakesLengthFromItsTendon) {
  // 3 cm of fibre for an excursion of some centimetres: straight is the longest, bent is where it rests.
  const Musculature muscles{{kneeUnit(0.03, 0.12)}};
  const std::vector<Posture> bent{postureFromDegrees(skeleton(), {{"knee_flexion_r", 55}})};
  const PathLimits limits = limitsOver(muscles, {zeroPosture(skeleton())});
  const auto kept = estimateLengths(skeleton(), muscles, limits, bent, {.smallest_ratio = 1}).front();
  const auto changed = estimateLengths(skeleton(), muscles, limits, bent).front();
  EXPECT_LT(kept.resting_normalized_fiber, 0.5);
  EXPECT_GT(changed.resting_normalized_fiber, kept.resting_normalized_fiber);
  EXPECT_LT(changed.ratio, 1);
  EXPECT_GE(changed.ratio, 0.7);
  EXPECT_TRUE(std::abs(changed.resting_normalized_fiber - 0.5) < 1e-4 || std::abs(changed.ratio - 0.7) < 1e-4);
  EXPECT_NEAR(1.6 * changed.optimal_fiber_length_m + 1.03 * changed.tendon_slack_length_m, changed.longest_path_m,
              1e-9);
}

TEST(LengthEstimation, AFiberThatWouldWorkTooShortTakesLengthFromItsTendonIfThatCures) {
  const std::vector<Posture> straight{zeroPosture(skeleton())},
      bent{postureFromDegrees(skeleton(), {{"knee_flexion_r", 60}})};
  for (const double fiber_m : {0.10, 0.07, 0.02}) {  // works as it is; is cured; cannot be cured
    const Musculature muscles{{kneeUnit(fiber_m, 0.22 - 1.09 * fiber_m)}};  // as long as the path at rest
    const PathLimits limits = limitsOver(muscles, straight), working = limitsOver(muscles, bent);
    const auto estimate = [&](const LengthEstimationOptions& options) {
      return estimateLengths(skeleton(), muscles, limits, straight, options, {working.shortest_m, {}}).front();
    };
    const auto fiber = [&](const LengthEstimate& e) {
      return equilibrium(withLengths(muscles, {e}).units[0], working.shortest_m[0], 0).normalized_fiber_length;
    };
    const LengthEstimate kept = estimate({.smallest_ratio = 1}), changed = estimate({});
    if (fiber_m == 0.07) {
      EXPECT_LT(fiber(kept), 0.4);
      EXPECT_GE(fiber(changed), 0.4);
      EXPECT_GE(changed.ratio, 0.7);
      EXPECT_LE(changed.optimal_fiber_length_m, 1.35 * fiber_m);
      EXPECT_LT(estimate({.longest_fiber_of_published = 1.01}).optimal_fiber_length_m,
                changed.optimal_fiber_length_m);  // bounded: left as published
    } else {
      EXPECT_EQ(changed.ratio, 1);
      EXPECT_EQ(fiber(changed) >= 0.5, fiber_m == 0.10);
    }
  }
}

TEST(LengthEstimation, StoredLengthsAreNeverShorterThanTheFit) {
  const Musculature muscles{{kneeUnit(0.1, 0.05)}};
  const std::vector<Posture> straight{zeroPosture(skeleton())};
  auto estimates = estimateLengths(skeleton(), muscles, limitsOver(muscles, straight), straight);
  const std::string csv = lengthsCsv(estimates, "a test");
  double fiber_m = 0, tendon_m = 0;
  ASSERT_EQ(std::sscanf(csv.c_str() + csv.find("\ntest_r,"), "\ntest_r,%lf,%lf,", &fiber_m, &tendon_m), 2);
  EXPECT_GE(fiber_m, estimates[0].optimal_fiber_length_m);
  EXPECT_GE(tendon_m, estimates[0].tendon_slack_length_m);
  EXPECT_LT(fiber_m, estimates[0].optimal_fiber_length_m + 2e-7);
}

}  // namespace
}  // namespace sinew
