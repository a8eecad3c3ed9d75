#include "core/file.h"
#include "tests/app/cli/cli_support.h"

namespace sinew {
namespace {

using test::documentOf;
using test::ProgramResult;
using test::sinewProgram;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(CliBench, ARowIsMeasuredOrSaysThatItsPeerIsMissing) {
  if (!std::filesystem::exists(std::filesystem::path{SINEW_EXECUTABLE}.parent_path() / "sinew-bench"))
    GTEST_SKIP() << "built without Google Benchmark";
  const ProgramResult result =
      sinewProgram({"bench", "--row", "4", "--windows", "2", "--window-seconds", "0.01", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json row = documentOf(result)["rows"][0];
  EXPECT_EQ(row["row"], 4);
  EXPECT_EQ(row["ours"]["windows"].size(), 2u);
  EXPECT_GT(row["ours"]["min_cpu_s"].get<double>(), 0);
  EXPECT_THAT(row["peer"].get<std::string>(), StartsWith("MuJoCo"));
  EXPECT_EQ(row["peer_times"].is_null(), row["ratio"].is_null());
}

TEST(CliBench, WrongRowsAreRefused) {
  EXPECT_EQ(sinewProgram({"bench", "--row", "77"}).status, 2);
}

TEST(CliExport, WritesMujocoXml) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "body.xml").string();
  ASSERT_EQ(sinewProgram({"export", "reference", "--format", "mjcf", "-o", file}).status, 0);
  EXPECT_THAT(readFile(file), StartsWith("<mujoco model=\"reference\">"));
  const ProgramResult wrong = sinewProgram({"export", "reference", "--format", "xyz", "-o", file});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("mjcf"));
}

}  // namespace
}  // namespace sinew
