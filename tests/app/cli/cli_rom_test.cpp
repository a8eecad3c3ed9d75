#include "core/file.h"
#include "tests/app/cli/cli_support.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using test::documentOf;
using test::ProgramResult;
using test::sinewProgram;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(CliRom, TheMapComesAsRunsAndTheKneeFreesTheHip) {
  const ProgramResult result =
      sinewProgram({"rom", "reference", "--joint", "hip_r", "--compare-with", "knee_flexion_r=90", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json map = documentOf(result);
  EXPECT_EQ(map["joint"], "hip_r");
  EXPECT_EQ(map["cells"], 23328);
  int cells = 0, valid = 0;
  for (std::size_t i = 0; i < map["map"].size(); ++i) {
    cells += map["map"][i].get<int>();
    if (i % 2 == 1) valid += map["map"][i].get<int>();
  }
  EXPECT_EQ(cells, 23328);
  EXPECT_EQ(valid, map["valid"].get<int>());
  const Json compare = map["compare"];
  EXPECT_GT(compare["valid"].get<int>(), valid);  // Ryu et al.: wider with the knee flexed
  EXPECT_EQ(compare["differing"].get<int>(), compare["only_first"].get<int>() + compare["only_second"].get<int>());
  EXPECT_NEAR(compare["of_all"].get<double>(), compare["differing"].get<int>() / 23328.0, 1e-12);
}

TEST(CliRom, DrawsTheSphere) {
  const test::TemporaryFolder folder;
  const auto file = folder / "hip.png";
  ASSERT_EQ(sinewProgram({"rom", "reference", "--joint", "hip_r", "-o", file.string()}).status, 0);
  EXPECT_TRUE(readFile(file).starts_with("\x89PNG"));
  EXPECT_THAT(sinewProgram({"rom", "reference", "--joint", "hip_r", "-o", "hip.bmp"}).err, HasSubstr(".png"));
}

TEST(CliRom, AModelDoesNotDifferFromItself) {
  const ProgramResult result = sinewProgram({"rom", "reference", "--joint", "shoulder_l", "--with",
                                             "elbow_flexion_l=30", "--compare", "reference", "--no-joint-limits"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("shoulder_l"), HasSubstr("differing, of all cells"), HasSubstr("0.0 %")));
}

TEST(CliRom, WrongInputIsAnsweredWithWhatIsExpected) {
  EXPECT_THAT(sinewProgram({"rom", "reference", "--joint", "knee_r"}).err, HasSubstr("ball-and-socket"));
  EXPECT_THAT(sinewProgram({"rom", "reference", "--joint", "hipr"}).err, HasSubstr("hip_r"));
  const ProgramResult value = sinewProgram({"rom", "reference", "--joint", "hip_r", "--with", "knee_flexion_r"});
  EXPECT_EQ(value.status, 2);
  EXPECT_THAT(value.err, HasSubstr("knee_flexion_r=90"));
  EXPECT_THAT(sinewProgram({"rom", "reference", "--joint", "hip_r", "--with", "knee_flexon_r=9"}).err,
              HasSubstr("knee_flexion_r"));
}

}  // namespace
}  // namespace sinew
