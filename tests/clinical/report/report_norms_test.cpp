#include "clinical/report/norms.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/file.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

TEST(Age, CountsCompletedMonthsInBothDateForms) {
  EXPECT_EQ(ageAt("2014-03-09", "2024-03-09"), (Age{10, 0}));
  EXPECT_EQ(ageAt("20140309", "2024-03-08"), (Age{9, 11}));
  EXPECT_EQ(ageAt("2014-12-31", "20150101"), (Age{0, 0}));
  EXPECT_DOUBLE_EQ((Age{12, 3}).inYears(), 12.25);
}

TEST(Age, IsUnknownRatherThanWrong) {
  for (const auto* day : {"", "2024", "2024-13-01", "2024-01-32", "2024/01/02", "20x40102", "2010-01-01"})
    EXPECT_FALSE(ageAt("2014-03-09", day)) << day;
}

class Norms : public testing::Test {
 protected:
  const NormTable table = loadNorms(test::resourceDir());
};

TEST_F(Norms, FemurOfABoyIsTheTableOfAndersonMessnerAndGreen) {
  const auto ten = table.normOf("femur_length", {"M", 10, {}});
  ASSERT_TRUE(ten);
  EXPECT_DOUBLE_EQ(ten->mean, 362.9);
  EXPECT_DOUBLE_EQ(ten->sd, 20.6);
  EXPECT_TRUE(ten->verified);
  const auto half = table.normOf("femur_length", {"M", 10.5, {}});
  EXPECT_NEAR(half->mean, (362.9 + 381.6) / 2, 1e-9);
  EXPECT_NEAR(half->sd, (20.6 + 22.4) / 2, 1e-9);
  // Their bones include the epiphyses: shown, but no z-score.
  EXPECT_FALSE(ten->comparable);
  EXPECT_TRUE(std::isnan(ten->zScore(400)));
}

TEST_F(Norms, ScoreOnlyWhereDefinitionAndSpreadAllow) {
  const auto hka = table.normOf("hka", {"", 30, {}});
  ASSERT_TRUE(hka);
  EXPECT_DOUBLE_EQ(hka->zScore(6), 2);
  const auto girl = table.normOf("femur_length", {"F", 10, {}});
  ASSERT_TRUE(girl);
  EXPECT_FALSE(girl->verified);
  EXPECT_TRUE(std::isnan(girl->sd));
}

TEST_F(Norms, AdultLengthsNeedTheHeight) {
  EXPECT_FALSE(table.normOf("femur_length", {"M", 40, {}}));
  const auto adult = table.normOf("femur_length", {"M", 40, 1.80});
  ASSERT_TRUE(adult);
  EXPECT_NEAR(adult->mean, 441, 1e-9);
}

TEST_F(Norms, NothingForWhomTheyDoNotHold) {
  EXPECT_FALSE(table.normOf("femur_length", {"M", {}, 1.7}));  // age not known
  EXPECT_FALSE(table.normOf("femur_length", {"", 10, {}}));    // sex not known
  EXPECT_FALSE(table.normOf("hka", {"M", 5, {}}));
  EXPECT_FALSE(table.normOf("femoral_torsion", {"M", 2, {}}));
  EXPECT_FALSE(table.normOf("pelvic_obliquity", {"M", 30, 1.8}));
  EXPECT_TRUE(table.normOf("leg_length_difference", {}));  // holds at any age
}

TEST_F(Norms, EveryFigureHasADefinition) {
  for (const auto* quantity :
       {"femur_length", "tibia_length", "leg_length", "hka", "neck_shaft_angle", "femoral_torsion", "tibial_torsion",
        "knee_flexion", "leg_length_difference", "pelvic_width", "pelvic_obliquity", "pelvic_tilt"})
    EXPECT_FALSE(table.textOf(quantity).definition.empty()) << quantity;
  EXPECT_EQ(table.textOf("a_new_figure").title, "a new figure");
}

TEST(NormsFile, ErrorsNameFileAndField) {
  const std::string head =
      R"({"format": "sinew.norms", "version": 1, "about": "", "figures": [)"
      R"({"quantity": "hka", "title": "HKA", "unit": "deg", "convention": "", "definition": "", "norms": [)";
  const std::pair<const char*, const char*> broken[] = {
      {R"({"by_age_y_mean_sd": [], "source": "", "verified": true, "same_definition": true}]}]})", "norms[0]"},
      {R"({"by_age_y_mean_sd": [[5, 1, 1], [4, 1, 1]], "source": "", "verified": true, "same_definition": true}]}]})",
       "rising"},
      {R"({"share_of_height": 0.2, "source": "", "verified": true, "same_definition": true}]}]})", "share_of_height"},
      {R"({"by_age_y_mean_sd": [[0, 1, 1]], "verified": true, "same_definition": true}]}]})", "source"},
      {R"({"age_y": [9, 3], "by_age_y_mean_sd": [[0, 1, 1]], "source": "", "verified": true, "same_definition": true}]}]})",
       "age_y"}};
  for (const auto& [text, field] : broken) {
    test::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "clinical");
    writeFileAtomically(folder / "clinical/norms.json", head + text);
    try {
      loadNorms(folder.path());
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string{error.what()}.find("norms.json"), std::string::npos) << error.what();
      EXPECT_NE(std::string{error.what()}.find(field), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace sinew
