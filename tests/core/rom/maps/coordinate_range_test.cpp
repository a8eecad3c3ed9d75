#include "core/rom/maps/coordinate_range.h"
#include "core/angle.h"

#include <gtest/gtest.h>

#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/plain_model.h"

namespace sinew {
namespace {

constexpr double kBisection_rad = 0.01 * kRadPerDeg;  // what the header promises

/// One muscle from the back of the right thigh to the back of the tibia, just long enough for `longest_at_deg` of
/// knee flexion: extension beyond that is held.
Model hamstringLike(double longest_at_deg) {
  Model model = test::plainModel();
  const Skeleton& s = model.skeleton;
  MusculotendonUnit unit;
  unit.name = "back_of_knee_r";
  unit.max_isometric_force_N = 1000;
  unit.path = {{PathPointRole::Origin, {test::anchorOn(s, "femur_r", {-0.05, -0.1, 0})}, "femur", "back"},
               {PathPointRole::Insertion, {test::anchorOn(s, "tibia_r", {-0.05, -0.06, 0})}, "tibia", "back"}};
  const auto X_WB = segmentPoses(s, postureFromDegrees(s, {{"knee_flexion_r", longest_at_deg}}));
  const double longest_m = pathLength(unit, X_WB);
  unit.optimal_fiber_length_m = 0.05;
  unit.tendon_slack_length_m = (longest_m - 1.6 * 0.05) / 1.03;
  model.musculature.units.push_back(unit);
  return model;
}

TEST(CoordinateRange, EndsWhereTheMuscleReachesItsLongestLength) {
  const Model model = hamstringLike(35);
  const Eigen::VectorXd bent = clinicalFromPosture(
      model.skeleton, postureFromDegrees(model.skeleton, {{"knee_flexion_r", 90}, {"hip_flexion_r", 20}}));
  const int knee = model.skeleton.coordinateIndex("knee_flexion_r");
  const CoordinateRange range = muscleInducedRange(model, bent, knee);
  EXPECT_NEAR(range.low_rad, 35 * kRadPerDeg, kBisection_rad);
  EXPECT_EQ(range.low_unit, model.musculature.unitIndex("back_of_knee_r"));
  EXPECT_EQ(range.high_rad, model.skeleton.coordinates[std::size_t(knee)].stop_max_rad);
  EXPECT_EQ(range.high_unit, -1);  // the joint's own end
}

TEST(CoordinateRange, FromAHeldPostureShowsTheNearestFreeInterval) {
  const Model model = hamstringLike(35);
  const int knee = model.skeleton.coordinateIndex("knee_flexion_r");
  const CoordinateRange range = muscleInducedRange(model, Eigen::VectorXd::Zero(50), knee);
  EXPECT_FALSE(range.isEmpty());
  EXPECT_NEAR(range.low_rad, 35 * kRadPerDeg, kBisection_rad);
}

TEST(CoordinateRange, WithoutAFreeAngleNamesTheMuscle) {
  Model model = hamstringLike(35);
  model.musculature.units.back().tendon_slack_length_m = 0.01;
  const CoordinateRange range =
      muscleInducedRange(model, Eigen::VectorXd::Zero(50), model.skeleton.coordinateIndex("knee_flexion_r"));
  EXPECT_TRUE(range.isEmpty());
  EXPECT_EQ(range.high_unit, model.musculature.unitIndex("back_of_knee_r"));
}

TEST(CoordinateRange, OtherJointsAreTheirEnvelope) {
  const Model model = hamstringLike(35);
  const auto ranges = muscleInducedRanges(model, Eigen::VectorXd::Zero(50));
  EXPECT_EQ(ranges.size(), 44u);  // all but the root's six
  for (const auto& range : ranges) {
    const Coordinate& c = model.skeleton.coordinates[std::size_t(range.coordinate)];
    if (c.name == "knee_flexion_r") continue;
    EXPECT_EQ(range.low_rad, c.stop_min_rad) << c.name;
    EXPECT_EQ(range.high_rad, c.stop_max_rad) << c.name;
  }
}

TEST(CoordinateRange, ACancelledOneIsEmpty) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(muscleInducedRanges(hamstringLike(35), Eigen::VectorXd::Zero(50), {{}, stop.get_token()}).empty());
}

}  // namespace
}  // namespace sinew
