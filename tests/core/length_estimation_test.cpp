#include "core/rom/length_estimation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "core/csv_table.h"
#include "core/file.h"
#include "core/muscle/evaluate.h"
#include "core/muscle/hill.h"
#include "core/muscle/load_musculature.h"
#include "core/muscle/muscle_path.h"
#include "core/rom/pose_sample.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

const Skeleton& skeleton() {
  static const Skeleton loaded = loadReferenceSkeleton(test::resourceDir());
  return loaded;
}

TEST(NormalPostures, StayInsideNormsAndCouplings) {
  const auto postures = normalPostures(skeleton(), 500);
  ASSERT_GT(postures.size(), 500u);
  for (const Posture& q : postures) {
    const Eigen::VectorXd clinical = clinicalFromPosture(skeleton(), q);
    for (int i = 0; i < clinical.size(); ++i) {
      const Coordinate& c = skeleton().coordinates[i];
      if (c.name.starts_with("shoulder")) continue;  // abducts beyond 90 deg: its three angles are not unique there
      EXPECT_GE(clinical[i], c.normal_min_rad - 1e-9) << c.name;
      EXPECT_LE(clinical[i], c.normal_max_rad + 1e-9) << c.name;
    }
    const double hip = clinical[skeleton().coordinateIndex("hip_flexion_r")] / kDeg;
    const double knee = clinical[skeleton().coordinateIndex("knee_flexion_r")] / kDeg;
    const double ankle = clinical[skeleton().coordinateIndex("ankle_dorsiflexion_r")] / kDeg;
    EXPECT_LE(hip, 86 + 0.5 * knee + 1e-5);
    EXPECT_LE(knee, 125 + 6 * hip + 1e-5);
    EXPECT_LE(ankle, 12 + 0.4 * knee + 1e-5);
  }
}

TEST(NormalPostures, FillTheRangeAndRepeat) {
  const auto a = normalPostures(skeleton(), 300), b = normalPostures(skeleton(), 300),
             other = normalPostures(skeleton(), 300, 1);
  ASSERT_EQ(a.size(), b.size());
  double largest_knee = 0, smallest_knee = 10;
  bool same_as_other = true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i], b[i]);
    same_as_other = same_as_other && a[i] == other[i];
  }
  for (std::size_t i = a.size() - 300; i < a.size(); ++i) {  // the random part
    const double knee = a[i][skeleton().coordinateIndex("knee_flexion_r")];
    largest_knee = std::max(largest_knee, knee);
    smallest_knee = std::min(smallest_knee, knee);
  }
  EXPECT_FALSE(same_as_other);
  EXPECT_LT(smallest_knee, 5 * kDeg);
  EXPECT_GT(largest_knee, 135 * kDeg);
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

TEST(LengthEstimation, LongestLengthIsTheLongestPath) {
  const Musculature muscles{{kneeUnit(0.1, 0.05)}};
  const std::vector<Posture> bent{postureFromDegrees(skeleton(), {{"knee_flexion_r", 60}}),
                                  postureFromDegrees(skeleton(), {{"knee_flexion_r", 30}}),
                                  postureFromDegrees(skeleton(), {{"knee_flexion_r", 90}})};
  const std::vector<Posture> resting{postureFromDegrees(skeleton(), {{"knee_flexion_r", 120}})};
  const auto estimate = estimateLengths(skeleton(), muscles, bent, resting, {.smallest_ratio = 1}).front();
  const double longest = pathLength(muscles.units[0], segmentPoses(skeleton(), bent[1]));
  EXPECT_DOUBLE_EQ(estimate.longest_path_m, longest);
  EXPECT_FALSE(estimate.relaxed);
  EXPECT_NEAR(1.6 * estimate.optimal_fiber_length_m + 1.03 * estimate.tendon_slack_length_m, longest, 1e-12);
  EXPECT_NEAR(estimate.tendon_slack_length_m / estimate.optimal_fiber_length_m, 0.5, 1e-12);
}

TEST(LengthEstimation, AUnitThatWouldPullAtRestIsLengthenedJustEnough) {
  const Musculature muscles{{kneeUnit(0.1, 0.05)}};
  const std::vector<Posture> straight{zeroPosture(skeleton())};
  const auto estimate = estimateLengths(skeleton(), muscles, straight, straight).front();
  EXPECT_TRUE(estimate.relaxed);
  MusculotendonUnit sized = muscles.units[0];
  sized.optimal_fiber_length_m = estimate.optimal_fiber_length_m;
  sized.tendon_slack_length_m = estimate.tendon_slack_length_m;
  EXPECT_NEAR(equilibrium(sized, estimate.longest_path_m, 0).force_N, 0.008 * 500, 1e-3);
  EXPECT_LT(estimate.resting_normalized_fiber, 1.1);
}

TEST(LengthEstimation, AFiberThatWouldStandTooShortTakesLengthFromItsTendon) {
  // 3 cm of fibre for an excursion of some centimetres: straight is the longest, bent is where it rests.
  const Musculature muscles{{kneeUnit(0.03, 0.12)}};
  const std::vector<Posture> straight{zeroPosture(skeleton())};
  const std::vector<Posture> bent{postureFromDegrees(skeleton(), {{"knee_flexion_r", 55}})};
  LengthEstimationOptions stiff;
  stiff.smallest_ratio = 1;
  const auto kept = estimateLengths(skeleton(), muscles, straight, bent, stiff).front();
  const auto changed = estimateLengths(skeleton(), muscles, straight, bent).front();
  EXPECT_LT(kept.resting_normalized_fiber, 0.5);
  EXPECT_GT(changed.resting_normalized_fiber, kept.resting_normalized_fiber);
  EXPECT_LT(changed.ratio, 1);
  EXPECT_GE(changed.ratio, 0.7);
  EXPECT_TRUE(std::abs(changed.resting_normalized_fiber - 0.5) < 1e-4 || std::abs(changed.ratio - 0.7) < 1e-4);
  EXPECT_NEAR(1.6 * changed.optimal_fiber_length_m + 1.03 * changed.tendon_slack_length_m, changed.longest_path_m,
              1e-9);
}

TEST(ReferenceLengths, StoredFileIsWhatTheFitGives) {
  test::TemporaryFolder folder;
  writeFileAtomically(folder / "fresh.csv", referenceLengthsCsv(test::resourceDir()));
  const std::vector<std::string> columns{"muscle", "optimal_fiber_length_m", "tendon_slack_length_m"};
  const CsvTable fresh{folder / "fresh.csv", "sinew.reference_lengths", 1, columns};
  const CsvTable stored{test::resourceDir() / "muscles" / "reference_lengths.csv", "sinew.reference_lengths", 1,
                        columns};
  ASSERT_EQ(fresh.rowCount(), stored.rowCount());
  for (std::size_t row = 0; row < fresh.rowCount(); ++row) {
    EXPECT_EQ(fresh.text(row, "muscle"), stored.text(row, "muscle"));
    for (const char* column : {"optimal_fiber_length_m", "tendon_slack_length_m"})  // five digits are stored
      EXPECT_NEAR(fresh.number(row, column), stored.number(row, column), 1.5e-5) << fresh.text(row, "muscle");
  }
}

TEST(ReferenceLengths, MakeEveryNormalPostureValidAndStandingEasy) {
  const Musculature muscles = loadMusculature(test::resourceDir(), skeleton());
  for (const Posture& q : normalPostures(skeleton())) {
    const auto X_WB = segmentPoses(skeleton(), q);
    for (const auto& unit : muscles.units)  // lengths are stored to 0.01 mm
      ASSERT_LE(pathLength(unit, X_WB), longestLength_m(unit) + 2e-5) << unit.name;
  }
  const auto standing = evaluatePosture(skeleton(), muscles, zeroPosture(skeleton()));
  for (const double fiber : standing.normalized_fiber_length) {
    EXPECT_LE(fiber, 1.1);
    EXPECT_GE(fiber, 0.49);
  }
}

/// Coordinate value at which passive resistance first reaches the torque, moving from -> to.
double angleAtTorque(const Musculature& muscles, std::map<std::string, double> posture, const std::string& coordinate,
                     double from, double to, double torque_Nm) {
  const int index = skeleton().coordinateIndex(coordinate);
  const double direction = to > from ? 1 : -1;
  for (double deg = from; direction * deg <= direction * to; deg += 0.5 * direction) {
    posture[coordinate] = deg;
    const auto e = evaluatePosture(skeleton(), muscles, postureFromDegrees(skeleton(), posture));
    if (-direction * e.passive_torque[index] >= torque_Nm) return deg;
  }
  return to;
}

TEST(ReferenceLengths, GiveTheClinicalTestsOfAnAdult) {
  const Musculature muscles = loadMusculature(test::resourceDir(), skeleton());
  const double popliteal = angleAtTorque(muscles, {{"hip_flexion_r", 90}}, "knee_flexion_r", 60, -10, 50);
  EXPECT_NEAR(popliteal, 30, 2);  // Ryu et al.: 30 deg at 50 N m
  const double straight_leg = angleAtTorque(muscles, {}, "hip_flexion_r", 30, 150, 50);
  const double bent_knee = angleAtTorque(muscles, {{"knee_flexion_r", 120}}, "hip_flexion_r", 60, 150, 50);
  EXPECT_GT(straight_leg, 60);  // Youdas 2005: 74 +- 9, range 60-95
  EXPECT_LT(straight_leg, 95);
  EXPECT_GT(bent_knee - straight_leg, 25);  // hamstrings are slack with a bent knee; adults 25-60
  const double silfverskioeld_straight = angleAtTorque(muscles, {}, "ankle_dorsiflexion_r", -20, 35, 20);
  const double silfverskioeld_bent =
      angleAtTorque(muscles, {{"knee_flexion_r", 90}}, "ankle_dorsiflexion_r", -20, 35, 20);
  EXPECT_NEAR(silfverskioeld_straight, 10, 6);  // DiGiovanni 2002, Baumbach 2014
  EXPECT_NEAR(silfverskioeld_bent, 21, 6);
  EXPECT_GE(silfverskioeld_bent - silfverskioeld_straight, 5);
}

}  // namespace
}  // namespace sinew
