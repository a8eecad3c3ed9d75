#include "core/file.h"
#include "tests/app/cli/cli_support.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using test::documentOf;
using test::ProgramResult;
using test::sinewProgram;
using ::testing::HasSubstr;

TEST(CliRomEdit, TheEditedModelHasTheNarrowerRange) {
  const test::TemporaryFolder folder;
  const std::string model = (folder / "edited.json").string(), edits = (folder / "edits.json").string();
  const ProgramResult result = sinewProgram({"rom-edit", "reference", "--joint", "hip_r", "--tilt", "forward=30",
                                             "--cone", "0.63", "--write-edits", edits, "-o", model, "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json json = documentOf(result);
  EXPECT_EQ(json["format"], "sinew.rom_edit_result");
  EXPECT_EQ(json["edits"][0]["tilt"]["towards"], "forward");
  EXPECT_LE(json["cells"][0]["muscles_and_stops"]["of_union"].get<double>(), 0.05);
  EXPECT_GT(json["changed"].size(), 0u);
  EXPECT_GT(json["limits"][0]["after_deg"][0].get<double>(), json["limits"][0]["before_deg"][0].get<double>());
  const Json rom = documentOf(sinewProgram({"rom", model, "--joint", "hip_r", "--compare", "reference", "--json"}));
  EXPECT_LT(rom["valid"].get<int>(), rom["compare"]["valid"].get<int>());
  // The file says the same as the options.
  const Json again = documentOf(sinewProgram({"rom-edit", "reference", "--edits", edits, "--json"}));
  EXPECT_EQ(again["changed"], json["changed"]);
}

TEST(CliRomEdit, WrongInputIsAnsweredWithWhatIsExpected) {
  const auto error = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"rom-edit", "reference"});
    const ProgramResult result = sinewProgram(arguments);
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_THAT(error({}), HasSubstr("--joint"));
  EXPECT_THAT(error({"--cone", "0.5"}), HasSubstr("--joint"));
  EXPECT_THAT(error({"--joint", "hipp_r", "--cone", "0.5"}), HasSubstr("hip_r"));
  EXPECT_THAT(error({"--joint", "hip_r", "--tilt", "30"}), HasSubstr("forward=30"));
  EXPECT_THAT(error({"--joint", "knee_r", "--cone", "0.5"}), HasSubstr("hinge"));
  EXPECT_THAT(error({"--joint", "hip_r", "--cone", "0"}), HasSubstr("0.05 to 5"));
  EXPECT_THAT(error({"--edits", "none.json"}), HasSubstr("none.json"));
}

}  // namespace
}  // namespace sinew
