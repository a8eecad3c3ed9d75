#include "core/rom/maps/rom_map.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/error.h"
#include "core/rom/maps/rom_cells_internal.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}
Model withoutMuscles() {
  Model model = reference();
  model.musculature.units.clear();
  return model;
}
RomMap mapOf(const std::string& joint, const std::map<std::string, double>& held_deg = {},
             const RomMapOptions& options = {}) {
  return romMap(reference(), joint, postureFromDegrees(reference().skeleton, held_deg), options);
}

TEST(RomMap, ACellIsATwistAboutTheShaftThenTheShortestSwingToADirection) {
  const RomMap map = romMap(withoutMuscles(), "hip_r", zeroPosture(reference().skeleton));
  EXPECT_TRUE(map.frame.shaft_J.isApprox(-Eigen::Vector3d::UnitY(), 1e-12));  // down to the knee
  EXPECT_TRUE(map.frame.forward_J.isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_NEAR(RomMap::twist_rad(0), -17 * std::numbers::pi / 18, 1e-12);
  for (const auto& [t, p, a] : {std::array{0, 0, 0}, std::array{9, 17, 5}, std::array{17, 35, 35}}) {
    const Eigen::Matrix3d R = map.R_JB(t, p, a);
    EXPECT_TRUE((R * R.transpose()).isIdentity(1e-12));
    EXPECT_TRUE((R * map.frame.shaft_J).isApprox(map.direction_J(p, a), 1e-12));
    EXPECT_NEAR(std::acos(map.frame.shaft_J.dot(map.direction_J(p, a))), (p + 0.5) * std::numbers::pi / 36, 1e-9);
    // Undoing the twist leaves a turn about an axis normal to the shaft.
    const Eigen::Vector3d swing =
        vectorFromRotation(R * rotationAbout<double>(map.frame.shaft_J, -RomMap::twist_rad(t)));
    EXPECT_NEAR(swing.dot(map.frame.shaft_J), 0, 1e-9);
  }
}

TEST(RomMap, EveryShaftPointsDownItsBone) {
  const Skeleton& s = reference().skeleton;
  const auto shaft = [&](const char* joint) { return romMap(withoutMuscles(), joint, zeroPosture(s)).frame.shaft_J; };
  EXPECT_LT(shaft("shoulder_r").y(), -0.99);  // arm hangs
  EXPECT_GT(shaft("lumbosacral").y(), 0.99);
  EXPECT_GT(shaft("cervicothoracic").y(), 0.98);
  EXPECT_GT(shaft("girdle_r").z(), 0.9);  // to the right shoulder
  EXPECT_LT(shaft("girdle_l").z(), -0.9);
  EXPECT_GT(shaft("ankle_l").x(), 0.99);  // heel to toe
  EXPECT_LT(shaft("wrist_r").y(), -0.99);
}

TEST(RomMap, WithoutMusclesItIsTheEnvelope) {
  const Model bare = withoutMuscles();
  const Posture zero = zeroPosture(bare.skeleton);
  EXPECT_EQ(romMap(bare, "hip_r", zero, {.joint_limits = false}).validCount(), RomMap::kCells);
  const RomMap map = romMap(bare, "hip_r", zero);
  const Joint& hip = bare.skeleton.joints[bare.skeleton.jointIndex("hip_r")];
  for (int t = 0; t < RomMap::kTwists; ++t)
    for (int p = 0; p < RomMap::kPolars; p += 5)
      for (int a = 0; a < RomMap::kAzimuths; ++a) {
        Posture q = zero;
        q.segment<3>(hip.first_coordinate) = vectorFromRotation(map.R_JB(t, p, a));
        const Eigen::VectorXd clinical = clinicalFromPosture(bare.skeleton, q);
        bool inside = true;
        for (int i = hip.first_coordinate; i < hip.first_coordinate + 3; ++i)
          inside = inside && clinical[i] >= bare.skeleton.coordinates[i].stop_min_rad &&
                   clinical[i] <= bare.skeleton.coordinates[i].stop_max_rad;
        EXPECT_EQ(map.valid[RomMap::cell(t, p, a)], inside) << t << " " << p << " " << a;
      }
  EXPECT_GT(map.validCount(), 0);
}

TEST(RomMap, LeftIsTheMirrorImageOfRight) {
  for (const std::string joint : {"hip", "shoulder", "ankle", "wrist", "girdle"}) {
    const RomMap right = mapOf(joint + "_r"), left = mapOf(joint + "_l");
    EXPECT_EQ(right.validCount(), left.validCount()) << joint;
    int differing = 0;
    for (int t = 0; t < RomMap::kTwists; ++t)
      for (int p = 0; p < RomMap::kPolars; ++p)
        for (int a = 0; a < RomMap::kAzimuths; ++a)
          differing += right.valid[RomMap::cell(t, p, a)] !=
                       left.valid[RomMap::cell(RomMap::kTwists - 1 - t, p, RomMap::kAzimuths - 1 - a)];
    EXPECT_EQ(differing, 0) << joint;
  }
}

TEST(RomMap, TheHipMovesFurtherWithTheKneeFlexed) {
  // Ryu et al.: the hamstrings are slack then. The envelope of the joint is the same in both.
  const RomMap straight = mapOf("hip_r"), flexed = mapOf("hip_r", {{"knee_flexion_r", 90}});
  EXPECT_GT(flexed.validCount(), straight.validCount());
}

TEST(RomMap, AMuscleThatIsTooLongForAPostureForbidsItsCell) {
  Model model = withoutMuscles();
  const int pelvis = model.skeleton.segmentIndex("pelvis"), femur = model.skeleton.segmentIndex("femur_r");
  // A string from the hip's centre of the pelvis, 0.1 m below it, to the same place on the femur: its length is the
  // chord of the swing, 0.2 sin(theta / 2), whatever the twist. Longest length 0.1 m is a cone of 60 degrees.
  MusculotendonUnit unit;
  unit.name = "string";
  unit.optimal_fiber_length_m = 0.1 / 1.6;
  unit.tendon_slack_length_m = 0;
  unit.path = {{PathPointRole::Origin, {{pelvis, 1, {0, -0.1, 0.086}}}, "", ""},
               {PathPointRole::Insertion, {{femur, 1, {0, -0.1, 0}}}, "", ""}};
  model.musculature.units.push_back(unit);
  const RomMap map = romMap(model, "hip_r", zeroPosture(model.skeleton), {.joint_limits = false});
  EXPECT_EQ(map.validCount(), RomMap::kTwists * RomMap::kAzimuths * 12);
  EXPECT_NEAR(map.twistWidth_rad(11, 3), 2 * std::numbers::pi, 1e-12);
  EXPECT_EQ(map.twistWidth_rad(12, 3), 0);
  // Only a unit that spans the joint counts.
  EXPECT_EQ(romMap(model, "hip_l", zeroPosture(model.skeleton), {.joint_limits = false}).validCount(),
            RomMap::kCells);
}

TEST(RomMap, TheRadiusTurnsWithTheWristButNotAsTheHandDoes) {
  const Skeleton& s = reference().skeleton;
  const auto names = [&](const char* joint) {
    std::vector<std::string> list;
    for (const int u : unitsSpanning(s, reference().musculature, s.jointIndex(joint)))
      list.push_back(reference().musculature.units[u].name);
    return list;
  };
  const auto wrist = names("wrist_r"), hip = names("hip_r");
  EXPECT_TRUE(std::ranges::count(wrist, "supinator_r"));  // ulna to radius
  EXPECT_TRUE(std::ranges::count(wrist, "pronator_quadratus_r"));
  EXPECT_FALSE(std::ranges::count(wrist, "brachialis_r"));   // humerus to ulna
  EXPECT_TRUE(std::ranges::count(hip, "rectus_femoris_r"));  // ends on the patella
  EXPECT_FALSE(std::ranges::count(hip, "soleus_medial_r"));
}

TEST(RomMap, TheFastCellsAreThoseOfTheReadableCode) {
  // Bit by bit, for every kind of joint, at every instruction set; every 7th cell, to be quick.
  const Skeleton& s = reference().skeleton;
  const Posture held =
      postureFromDegrees(s, {{"knee_flexion_r", 60}, {"elbow_flexion_r", 40}, {"hip_flexion_l", 20}});
  for (const char* joint :
       {"hip_r", "ankle_r", "lumbosacral", "cervicothoracic", "girdle_r", "shoulder_l", "wrist_r"}) {
    const RomMap map = romMap(reference(), joint, held, {.joint_limits = false});
    CellJudge judge{reference(), s.jointIndex(joint), held};
    int differing = 0;
    for (int i = 0; i < RomMap::kCells; i += 7) {
      const int t = i / (36 * 36), p = i / 36 % 36, a = i % 36;
      differing += map.valid[i] != judge.allows(map.R_JB(t, p, a));
    }
    EXPECT_EQ(differing, 0) << joint;
  }
}

TEST(RomMap, DifferencesAreCountedBothWays) {
  RomMap first{"hip_r", {}, std::vector<std::uint8_t>(RomMap::kCells, 0)}, second = first;
  for (int i = 0; i < 30; ++i) first.valid[i] = 1;
  for (int i = 20; i < 40; ++i) second.valid[i] = 1;
  const RomDifference d = compare(first, second);
  EXPECT_EQ(d.only_first, 20);
  EXPECT_EQ(d.only_second, 10);
  EXPECT_EQ(d.differing(), 30);
  EXPECT_NEAR(d.ofUnion(), 30.0 / 40, 1e-15);
  EXPECT_NEAR(d.ofAll(), 30.0 / 23328, 1e-15);
  second.joint = "hip_l";
  EXPECT_THROW(compare(first, second), InputError);
}

TEST(RomMap, OnlyBallJointsHaveOne) {
  EXPECT_THROW(mapOf("knee_r"), InputError);
  EXPECT_THROW(mapOf("root"), InputError);
  EXPECT_THROW(mapOf("hipp_r"), InputError);
}

}  // namespace
}  // namespace sinew
