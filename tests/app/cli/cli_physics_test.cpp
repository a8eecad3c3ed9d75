// `sinew model shape` and `sinew model physics`.
#include <algorithm>

#include "core/file.h"
#include "tests/app/cli/cli_support.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using test::documentOf;
using test::sinewProgram;
using ::testing::AllOf;
using ::testing::HasSubstr;

double massRatio(const Json& document, const std::string& segment) {
  for (const auto& s : document["segments"])
    if (s["segment"] == segment) return s["mass_ratio"];
  return -1;
}

TEST(CliPhysics, ShapeOfAPresetBecomesAModel) {
  const test::TemporaryFolder folder;
  const auto made = sinewProgram({"model", "shape", "alien", "--json", "-o", (folder / "alien.json").string()});
  ASSERT_EQ(made.status, 0) << made.err;
  const Json document = documentOf(made);
  EXPECT_NEAR(massRatio(document, "femur_l"), 2.5, 1e-9);
  EXPECT_EQ(document["body"]["humerus"]["torsion_deg"], -10);
  const auto info = sinewProgram({"model", "info", (folder / "alien.json").string(), "--json"});
  ASSERT_EQ(info.status, 0) << info.err;
  EXPECT_EQ(documentOf(info)["name"], "alien");
  EXPECT_NEAR(documentOf(info)["mass_kg"].get<double>(), document["mass_kg"].get<double>(), 1e-9);
}

TEST(CliPhysics, ShapeOfAFileAndWrongOnes) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "tall.json", R"({"femur": {"elongation": 1.2}})");
  writeFileAtomically(folder / "wrong.json", R"({"femur": {"elongaton": 1.2}})");
  const auto tall = sinewProgram({"model", "shape", (folder / "tall.json").string(), "--json"});
  ASSERT_EQ(tall.status, 0) << tall.err;
  EXPECT_EQ(documentOf(tall)["body"]["name"], "tall");
  const auto wrong = sinewProgram({"model", "shape", (folder / "wrong.json").string()});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("femur.elongaton"), HasSubstr("femur.elongation")));
  const auto unknown = sinewProgram({"model", "shape", "hulc"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("hulk"));
}

TEST(CliPhysics, EditsMassesStrengthsAndCurvesAndKeepsTheRecord) {
  const test::TemporaryFolder folder;
  const std::string first = (folder / "first.json").string(), second = (folder / "second.json").string();
  const auto edit = sinewProgram({"model", "physics", "reference", "--mass", "trunk=1.2", "--strength",
                                  "quadriceps=0.8", "--curve", "soleus.active_width=0.5", "-o", first, "--json"});
  ASSERT_EQ(edit.status, 0) << edit.err;
  const Json document = documentOf(edit);
  EXPECT_NEAR(massRatio(document, "thorax"), 1.2, 1e-9);
  EXPECT_NEAR(massRatio(document, "femur_r"), 1, 1e-9);
  EXPECT_NEAR(document["strength_ratios"]["rectus_femoris_r"].get<double>(), 0.8, 1e-9);
  EXPECT_EQ(document["edited_curves"], 4);
  // A second edit keeps the first.
  const auto again = sinewProgram({"model", "physics", first, "--mass", "head=1.1", "-o", second, "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NEAR(massRatio(documentOf(again), "thorax"), 1.2, 1e-9);
  EXPECT_NEAR(massRatio(documentOf(again), "head"), 1.1, 1e-9);
  EXPECT_EQ(documentOf(again)["edited_curves"], 4);
  EXPECT_EQ(documentOf(again)["factors"]["strength_factors"]["quadriceps"], 0.8);
}

TEST(CliPhysics, BadFactorsAreUnusableInput) {
  const test::TemporaryFolder folder;
  const std::string out = (folder / "out.json").string();
  const auto complaint = [&](const std::string& option, const std::string& value) {
    const auto result = sinewProgram({"model", "physics", "reference", option, value, "-o", out});
    EXPECT_EQ(result.status, 2) << option << " " << value;
    return result.err;
  };
  EXPECT_THAT(complaint("--mass", "trnk=1.2"), HasSubstr("trunk"));
  EXPECT_THAT(complaint("--mass", "trunk"), HasSubstr("NAME=NUMBER"));
  EXPECT_THAT(complaint("--mass", "trunk=0"), HasSubstr("0.01 to 100"));
  EXPECT_THAT(complaint("--strength", "quadricps=1"), HasSubstr("quadriceps"));
  EXPECT_THAT(complaint("--curve", "soleus.activ_width=0.5"), HasSubstr("active_width"));
  EXPECT_THAT(complaint("--curve", "soleus.active_width=-1"), HasSubstr("0.05 ... 5"));
  EXPECT_THAT(complaint("--curve", "soleus=1"), HasSubstr("MUSCLE.PARAMETER"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace sinew
