#include "core/posture/muscle_role.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "core/model/model.h"
#include "core/muscle/load_musculature.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/mirrored_posture.h"
#include "core/skeleton/motion_words.h"
#include "core/skeleton/posture_file.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MuscleRole : public ::testing::Test {
 protected:
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  const Musculature musculature = loadMusculature(test::resourceDir(), skeleton);
  const Posture standing = zeroPosture(skeleton);

  std::vector<std::string> jointsOf(const char* unit) {
    const auto spanned = spannedCoordinates(musculature.unit(unit), clinicalKinematics(skeleton, standing));
    std::vector<std::string> names;
    for (const int j : crossedJoints(skeleton, spanned)) names.push_back(skeleton.joints[std::size_t(j)].name);
    return names;
  }
};

TEST_F(MuscleRole, CrossesTheJointsOfAnatomy) {
  EXPECT_THAT(jointsOf("semitendinosus_r"), ElementsAre("hip_r", "knee_r"));
  EXPECT_THAT(jointsOf("soleus_medial_l"), ElementsAre("ankle_l"));
  EXPECT_THAT(jointsOf("rectus_femoris_r"), ElementsAre("hip_r", "knee_r"));  // its end on the patella moves with it
}

TEST_F(MuscleRole, TurnsAndShortensAsItsNameSays) {
  const auto e = evaluatePosture(skeleton, musculature, standing);
  const int unit = musculature.unitIndex("semitendinosus_r");
  const auto actions = muscleActions(e, unit);
  ASSERT_GE(actions.size(), 2u);
  EXPECT_GE(std::abs(actions[0].moment_arm_m), std::abs(actions[1].moment_arm_m));
  std::set<std::string> words;
  for (const auto& a : actions)
    words.insert(motionWords(skeleton.coordinates[std::size_t(a.coordinate)].name, a.moment_arm_m > 0));
  EXPECT_TRUE(words.contains("hip extension") && words.contains("knee flexion"));

  const auto motions = loadJointMotions(test::resourceDir(), skeleton);
  std::set<std::string> shortens;
  for (const auto& f : muscleFunctions(skeleton, musculature.unit("semitendinosus_r"), motions))
    shortens.insert(f.motion->name);
  EXPECT_TRUE(shortens.contains("hip_extension_r") && shortens.contains("knee_flexion_r"));
  EXPECT_FALSE(shortens.contains("hip_flexion_r") || shortens.contains("knee_flexion_l"));
}

TEST_F(MuscleRole, AgonistsOfOppositeWaysAreDifferent) {
  const auto e = evaluatePosture(skeleton, musculature, standing);
  const int knee = skeleton.coordinateIndex("knee_flexion_r");
  const auto flexors = agonists(e, knee, true), extensors = agonists(e, knee, false);
  EXPECT_THAT(flexors, ::testing::Contains(musculature.unitIndex("semitendinosus_r")));
  EXPECT_THAT(extensors, ::testing::Contains(musculature.unitIndex("rectus_femoris_r")));
  for (const int i : flexors) EXPECT_THAT(extensors, ::testing::Not(::testing::Contains(i)));
}

TEST_F(MuscleRole, EveryCoordinateHasTwoWords) {
  for (const auto& c : skeleton.coordinates) {
    EXPECT_NE(motionWords(c.name, true), motionWords(c.name, false));
    EXPECT_THAT(motionWords(c.name, false), ::testing::Not(HasSubstr("less "))) << c.name;
  }
  EXPECT_EQ(motionWords("knee_flexion_l", false), "knee extension");
}

TEST_F(MuscleRole, WordsAgreeWithTheJointMotions) {
  for (const auto& motion : loadJointMotions(test::resourceDir(), skeleton)) {
    const std::string words = motionWords(motion.coordinate, motion.end_deg > motion.start_deg);
    EXPECT_TRUE(motion.title.starts_with(words) || words.starts_with(motion.title)) << motion.title << " / " << words;
  }
}

TEST_F(MuscleRole, TheMirrorImageIsItsOwnInverseAndExchangesSides) {
  std::mt19937_64 random{3};
  const Eigen::VectorXd x = test::randomClinical(skeleton, random), image = mirroredClinical(skeleton, x);
  EXPECT_EQ(mirroredClinical(skeleton, image), x);
  EXPECT_EQ(image[skeleton.coordinateIndex("hip_adduction_l")], x[skeleton.coordinateIndex("hip_adduction_r")]);
  // Landmarks of the image lie where the mirror shows them: 1 um, for the left bones are copies of the right ones.
  const auto X = segmentPoses(skeleton, postureFromClinical(skeleton, x)),
             Y = segmentPoses(skeleton, postureFromClinical(skeleton, image));
  for (const auto& landmark : skeleton.landmarks)
    if (landmark.name.ends_with("_r")) {
      const auto& other = skeleton.landmark(std::string{withoutSide(landmark.name)} + "_l");
      EXPECT_LT(
          (mirrored(X[std::size_t(landmark.segment)] * landmark.p_BL) - Y[std::size_t(other.segment)] * other.p_BL)
              .norm(),
          1e-6)
          << landmark.name;
    }
}

TEST_F(MuscleRole, PresetPosturesArePossible) {
  const Model model = loadReferenceModel(test::resourceDir());
  const auto presets = loadPresetPostures(test::resourceDir(), model.skeleton);
  EXPECT_GE(presets.size(), 6u);
  for (const auto& preset : presets)
    EXPECT_TRUE(evaluatePosture(model.skeleton, model.musculature, preset.posture).valid) << preset.name;
}

TEST_F(MuscleRole, PostureFilesAreListsOrCarryAFormat) {
  test::TemporaryFolder folder;
  const auto file = folder / "postures.json";
  writeFileAtomically(file, R"([{"name": "bent", "coordinates_deg": {"knee_flexion_r": 90}}])");
  const auto bare = loadPostures(file, skeleton);
  ASSERT_EQ(bare.size(), 1u);
  EXPECT_EQ(bare[0].name, "bent");
  writeFileAtomically(file, R"([{"name": "bent", "coordinates_deg": {"knee_flexoin_r": 90}}])");
  EXPECT_THROW(loadPostures(file, skeleton), InputError);
  writeFileAtomically(file, R"({"format": "sinew.postures", "version": 2, "postures": []})");
  EXPECT_THROW(loadPostures(file, skeleton), InputError);
}

}  // namespace
}  // namespace sinew
