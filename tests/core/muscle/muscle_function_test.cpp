// What the reference muscles do, against anatomy and published moment arms (tables in tests/data).
#include <gmock/gmock.h>

#include <map>

#include "core/error.h"
#include "core/file.h"
#include "core/muscle/load_musculature.h"
#include "core/muscle/moment_references.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

class MuscleFunction : public testing::Test {
 protected:
  std::string nameOf(int unit, int coordinate) const {
    return musculature_.units[static_cast<std::size_t>(unit)].name + " about " +
           skeleton_.coordinates[static_cast<std::size_t>(coordinate)].name;
  }
  const Skeleton skeleton_ = loadReferenceSkeleton(test::resourceDir());
  const Musculature musculature_ = loadMusculature(test::resourceDir(), skeleton_);
};

TEST_F(MuscleFunction, PrincipalAndSecondaryMomentsHaveTheAnatomicalSign) {
  const auto references =
      loadFunctionReferences(test::testDataDir() / "muscle_functions.csv", skeleton_, musculature_);
  const auto verdicts = judgeFunctions(skeleton_, musculature_, references);
  std::map<FunctionStrength, int> all, right;
  int kept = 0;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto& r = references[i];
    ++all[r.strength];
    right[r.strength] += verdicts[i].right;
    const std::string name = nameOf(r.unit, r.coordinate);
    const char* sign = r.sign > 0 ? "+" : "-";
    if (r.strength == FunctionStrength::PostureDependent) {
      std::printf("posture-dependent: %s, expected %s: %.2f cm, right over %.0f %% of %g to %g deg\n", name.c_str(),
                  sign, verdicts[i].arm_cm, 100 * verdicts[i].share_of_range, r.min_deg, r.max_deg);
      continue;
    }
    if (r.strength == FunctionStrength::Principal) {
      EXPECT_TRUE(verdicts[i].right) << name << ": " << verdicts[i].arm_cm << " cm";
      kept += verdicts[i].share_of_range >= 0.9;
      if (verdicts[i].share_of_range < 0.9)
        std::printf("turns: %s, expected %s: right over %.0f %% of %g to %g deg\n", name.c_str(), sign,
                    100 * verdicts[i].share_of_range, r.min_deg, r.max_deg);
    } else if (!verdicts[i].right) {
      std::printf("wrong: %s, expected %s: %.2f cm\n", name.c_str(), sign, verdicts[i].arm_cm);
    }
  }
  EXPECT_EQ(all[FunctionStrength::Principal], 177);
  EXPECT_EQ(all[FunctionStrength::Secondary], 99);
  EXPECT_EQ(all[FunctionStrength::PostureDependent], 31);
  EXPECT_GE(kept, 0.98 * all[FunctionStrength::Principal]);
  EXPECT_GE(right[FunctionStrength::Secondary], 0.95 * all[FunctionStrength::Secondary]);
  std::printf("principal right: %d of %d, over nine tenths of the range %d; secondary right: %d of %d\n",
              right[FunctionStrength::Principal], all[FunctionStrength::Principal], kept,
              right[FunctionStrength::Secondary], all[FunctionStrength::Secondary]);
}

TEST_F(MuscleFunction, MomentArmsLieInThePublishedRange) {
  const auto references = loadMomentArmReferences(test::testDataDir() / "moment_arms.csv", skeleton_, musculature_);
  const auto verdicts = judgeMomentArms(skeleton_, musculature_, references);
  ASSERT_EQ(references.size(), 311u);
  int inside = 0;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto& r = references[i];
    const std::string name = nameOf(r.unit, r.coordinate);
    const double angle_deg = r.posture_deg.at(skeleton_.coordinates[static_cast<std::size_t>(r.coordinate)].name);
    inside += verdicts[i].inside;
    EXPECT_FALSE(verdicts[i].wrong_sign) << name << " at " << angle_deg << " deg";
    if (!verdicts[i].inside)
      std::printf("outside: %s at %g deg: %.2f cm, accepted %.2f to %.2f\n", name.c_str(), angle_deg,
                  verdicts[i].arm_cm, r.min_cm, r.max_cm);
  }
  std::printf("moment arms inside: %d of %zu\n", inside, references.size());
  EXPECT_GE(inside, 0.95 * static_cast<double>(references.size()));
}

/// Tables of others: their names of columns, names without side, both rows of a function.
class ForeignTable : public MuscleFunction {
 protected:
  std::filesystem::path fileOf(const std::string& content) {
    writeFileAtomically(folder_ / "table.csv", content);
    return folder_ / "table.csv";
  }
  std::string complaint(const std::string& content) {
    try {
      loadMomentArmReferences(fileOf(content), skeleton_, musculature_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  const std::string header_ = "muscle,dof,pose_other_dofs,angle_deg,reference_cm,accept_min_cm,accept_max_cm\n";
  test::TemporaryFolder folder_;
};

TEST_F(ForeignTable, OfMomentArmsIsRead) {
  const auto references =
      loadMomentArmReferences(fileOf(header_ + "soleus_medial,ankle_dorsiflexion,knee_flexion=30,10,-4.5,-6,-3\n"
                                               "soleus_medial_l,ankle_dorsiflexion_l,,0,-4.5,4,5\n"
                                               "rectus_abdominis,lumbar_flexion,,0,8,4,12\n"),
                              skeleton_, musculature_);
  ASSERT_EQ(references.size(), 3u);
  EXPECT_EQ(nameOf(references[0].unit, references[0].coordinate), "soleus_medial_r about ankle_dorsiflexion_r");
  EXPECT_EQ(references[0].posture_deg,
            (std::map<std::string, double>{{"knee_flexion_r", 30}, {"ankle_dorsiflexion_r", 10}}));
  EXPECT_EQ(nameOf(references[2].unit, references[2].coordinate), "rectus_abdominis_r about lumbar_flexion");
  const auto verdicts = judgeMomentArms(skeleton_, musculature_, references);
  EXPECT_TRUE(verdicts[0].inside);
  EXPECT_FALSE(verdicts[1].inside);
  EXPECT_FALSE(verdicts[1].wrong_sign);
}

TEST_F(ForeignTable, OfFunctionsCountsBothRowsOnce) {
  const auto references =
      loadFunctionReferences(fileOf("muscle,dof,sign,role,strength,test_min_deg,test_max_deg,test_pose\n"
                                    "soleus_medial_r,ankle_dorsiflexion,-,agonist,principal,-40,20,\n"
                                    "soleus_medial_r,ankle_dorsiflexion,-,antagonist,principal,-40,20,\n"),
                             skeleton_, musculature_);
  ASSERT_EQ(references.size(), 1u);
  const auto verdicts = judgeFunctions(skeleton_, musculature_, references);
  EXPECT_TRUE(verdicts[0].right);
  EXPECT_EQ(verdicts[0].share_of_range, 1);
}

TEST_F(ForeignTable, IsAnsweredWithLineAndField) {
  using testing::AllOf, testing::HasSubstr;
  EXPECT_THAT(complaint("muscle,dof\n"), HasSubstr("table.csv: header: expected a column 'other_posture_deg'"));
  EXPECT_THAT(complaint(header_ + "soleus,ankle_dorsiflexion,,0,1,0,2\n"),
              AllOf(HasSubstr("table.csv: line 2"), HasSubstr("nearest: soleus_")));
  EXPECT_THAT(complaint(header_ + "soleus_medial,ankle_dorsi,,0,1,0,2\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("nearest: ankle_")));
  EXPECT_THAT(complaint(header_ + "soleus_medial,ankle_dorsiflexion,knee 30,0,1,0,2\n"),
              HasSubstr("pose_other_dofs: expected coordinate=degrees"));
  EXPECT_THAT(complaint(header_ + "soleus_medial,ankle_dorsiflexion,,0,1,3,2\n"), HasSubstr("accept_min_cm"));
  EXPECT_THAT(complaint(header_ + "soleus_medial,ankle_dorsiflexion,,x,1,0,2\n"), HasSubstr("angle_deg"));
}

}  // namespace
}  // namespace sinew
