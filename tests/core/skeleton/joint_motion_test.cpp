#include "core/skeleton/joint_motion.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <numbers>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::HasSubstr;

class JointMotions : public testing::Test {
 protected:
  const Skeleton skeleton_ = loadReferenceSkeleton(test::resourceDir());
  const std::vector<JointMotion> motions_ = loadJointMotions(test::resourceDir(), skeleton_);

  /// Complaint after `from` became `to` in a copy of the shipped file.
  std::string complaint(const std::string& from, const std::string& to) {
    std::string text = readFile(test::resourceDir() / "skeleton" / "joint_motions.json");
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    std::filesystem::create_directories(folder_ / "skeleton");
    writeFileAtomically(folder_.path() / "skeleton" / "joint_motions.json", text.replace(at, from.size(), to));
    try {
      loadJointMotions(folder_.path(), skeleton_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  test::TemporaryFolder folder_;
};

TEST_F(JointMotions, CoverEveryJointOnBothSides) {
  EXPECT_EQ(motions_.size(), 2u * 30 + 20);  // 30 of the limbs a side, 20 of the midline
  std::set<std::string> joints, names;
  for (const auto& motion : motions_) {
    joints.insert(motion.joint);
    names.insert(motion.name);
    const Coordinate& c = skeleton_.coordinates[skeleton_.coordinateIndex(motion.coordinate)];
    EXPECT_EQ(skeleton_.joints[c.joint].name, motion.joint) << motion.name;
    for (const double deg : {motion.start_deg, motion.end_deg}) {  // nobody is asked for more than athletes can
      EXPECT_GE(deg * std::numbers::pi / 180, c.athlete_min_rad) << motion.name;
      EXPECT_LE(deg * std::numbers::pi / 180, c.athlete_max_rad) << motion.name;
    }
  }
  EXPECT_EQ(names.size(), motions_.size());
  EXPECT_EQ(joints.size(), skeleton_.joints.size() - 1);  // all but the root
}

TEST_F(JointMotions, AreFoundByNameTitleAndSide) {
  EXPECT_EQ(findMotion(motions_, "knee_flexion_l").coordinate, "knee_flexion_l");
  EXPECT_EQ(findMotion(motions_, "knee_flexion").name, "knee_flexion_r");
  EXPECT_EQ(findMotion(motions_, "knee_flexion", 'l').name, "knee_flexion_l");
  EXPECT_EQ(findMotion(motions_, "foot dorsiflexion", 'l').name, "ankle_dorsiflexion_l");
  EXPECT_EQ(findMotion(motions_, "lumbar_flexion", 'l').name, "lumbar_flexion");
  try {
    findMotion(motions_, "knee_flexoin");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nearest: knee_flexion_"));
  }
}

TEST_F(JointMotions, HaveMirrorImages) {
  const std::vector<int> mirror_of = mirrorMotions(skeleton_, motions_);
  const auto mirrorOf = [&](std::string_view name) {
    const auto index = &findMotion(motions_, name) - motions_.data();
    const int image = mirror_of[static_cast<std::size_t>(index)];
    EXPECT_EQ(mirror_of.at(static_cast<std::size_t>(image)), index) << name;
    return motions_.at(static_cast<std::size_t>(image)).name;
  };
  EXPECT_EQ(mirrorOf("hip_medial_rotation_l"), "hip_medial_rotation_r");
  EXPECT_EQ(mirrorOf("forearm_supination_r"), "forearm_supination_l");
  EXPECT_EQ(mirrorOf("neck_rotation_left"), "neck_rotation_right");
  EXPECT_EQ(mirrorOf("lumbar_lateral_flexion_right"), "lumbar_lateral_flexion_left");
  EXPECT_EQ(mirrorOf("thorax_extension"), "thorax_extension");

  const JointMotion alone{.name = "bend", .coordinate = "neck_lateral_flexion", .start_deg = -30, .end_deg = 20};
  EXPECT_EQ(mirrorMotions(skeleton_, {alone}), std::vector{-1});
}

TEST_F(JointMotions, PostureMovesTheNamedCoordinateLinearly) {
  const JointMotion& motion = findMotion(motions_, "forearm_pronation_r");
  for (const double theta : {0.0, 0.25, 1.0}) {
    const Eigen::VectorXd clinical =
        clinicalFromPosture(skeleton_, motionPosture(skeleton_, motion, theta)) * 180 / std::numbers::pi;
    EXPECT_NEAR(clinical[skeleton_.coordinateIndex("forearm_pronation_r")], -45 + 75 * theta, 1e-9);
    EXPECT_NEAR(clinical[skeleton_.coordinateIndex("elbow_flexion_r")], 90, 1e-9);
    EXPECT_NEAR(clinical[skeleton_.coordinateIndex("elbow_flexion_l")], 0, 1e-9);
  }
}

TEST_F(JointMotions, BrokenFilesAreAnsweredWithTheField) {
  EXPECT_THAT(complaint("\"coordinate\": \"hip_flexion_r\"", "\"coordinate\": \"hip_flexoin_r\""),
              testing::AllOf(HasSubstr("motions[0]"), HasSubstr("nearest: hip_flexion_r")));
  EXPECT_THAT(complaint("\"end_deg\": 90", "\"end_deg\": \"90\""), HasSubstr("motions[0].end_deg"));
  EXPECT_THAT(complaint("\"end_deg\": 90", "\"end_deg\": -15"), HasSubstr("another angle than start_deg"));
  EXPECT_THAT(complaint("\"hip_extension_r\"", "\"hip_flexion_r\""), HasSubstr("twice"));
  EXPECT_THAT(complaint("\"version\": 1", "\"version\": 3"), HasSubstr("version"));
}

}  // namespace
}  // namespace sinew
