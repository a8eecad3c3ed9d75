// `sinew retarget` and `sinew experiment`.
#include <csignal>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

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

TEST(CliRetarget, MakesAModelThatEveryOtherCommandReads) {
  const test::TemporaryFolder folder;
  const std::string model = (folder / "hulk.json").string();
  const auto made = sinewProgram({"retarget", "--shape", "hulk", "-o", model, "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  const Json document = documentOf(made);
  EXPECT_EQ(document["format"], "sinew.retarget");
  EXPECT_EQ(document["method"], "sinew");
  ASSERT_EQ(document["muscles"].size(), 282u);
  const Json& muscle = document["muscles"][0];
  for (const char* member : {"name", "energy_start", "energy_end", "iterations", "outcome", "largest_move_mm"})
    EXPECT_TRUE(muscle.contains(member)) << member;
  for (const auto& m : document["muscles"]) {
    EXPECT_LE(m["energy_end"].get<double>(), m["energy_start"].get<double>() + 1e-12) << m["name"];
    EXPECT_LE(std::abs(m["fiber_tendon_ratio"].get<double>() - 1), 0.3 + 1e-9) << m["name"];
  }
  ASSERT_FALSE(document["peak_torque"].empty());
  for (const char* member : {"motion", "reference_deg", "before_deg", "after_deg"})
    EXPECT_TRUE(document["peak_torque"][0].contains(member)) << member;
  double seconds = 0;
  for (const auto& [step, taken] : document["seconds_by_step"].items()) seconds += taken.get<double>();
  EXPECT_NEAR(document["seconds"].get<double>(), seconds, 1e-9);  // rounding
  EXPECT_EQ(document["files"]["model"], model);

  const auto info = sinewProgram({"model", "info", model, "--json"});
  ASSERT_EQ(info.status, 0) << info.err;
  EXPECT_EQ(documentOf(info)["name"], "hulk");
  EXPECT_EQ(documentOf(info)["muscles"], 282);
  EXPECT_EQ(sinewProgram({"model", "validate", model}).status, 0);
  EXPECT_EQ(sinewProgram({"curve", model, "--muscle", "iliacus_anterior_r", "--motion", "hip_flexion"}).status, 0);
  EXPECT_EQ(sinewProgram({"rom", model, "--joint", "hip_r", "--compare", "reference"}).status, 0);
  EXPECT_EQ(sinewProgram({"export", model, "--format", "mjcf", "-o", (folder / "hulk.xml").string()}).status, 0);
  const auto postures = folder / "postures.json";
  writeFileAtomically(postures, R"([{"name": "standing", "coordinates_deg": {}}])");
  const auto evaluated =
      sinewProgram({"evaluate", model, "--postures", postures.string(), "--what", "validity", "--json"});
  ASSERT_EQ(evaluated.status, 0) << evaluated.err;
  EXPECT_EQ(documentOf(evaluated)["postures"][0]["valid"], true);
}

TEST(CliRetarget, TheReferencesOwnShapeMovesNothing) {
  const test::TemporaryFolder folder;
  const auto made = sinewProgram({"retarget", "--shape", "human", "-o", (folder / "human.json").string(), "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  for (const auto& m : documentOf(made)["muscles"]) EXPECT_LT(m["largest_move_mm"].get<double>(), 0.1) << m["name"];
}

TEST(CliRetarget, WrongInputIsAnsweredWithWhatIsExpected) {
  const test::TemporaryFolder folder;
  const std::string model = (folder / "m.json").string();
  const auto method = sinewProgram({"retarget", "--shape", "hulk", "--method", "papper", "-o", model});
  EXPECT_EQ(method.status, 2);
  EXPECT_THAT(method.err, AllOf(HasSubstr("papper"), HasSubstr("paper")));
  const auto shape = sinewProgram({"retarget", "--shape", "hulc", "-o", model});
  EXPECT_EQ(shape.status, 2);
  EXPECT_THAT(shape.err, HasSubstr("hulk"));
  const auto reference = sinewProgram({"retarget", "--shape", "hulk", "--reference", "body.json", "-o", model});
  EXPECT_EQ(reference.status, 2);
  EXPECT_THAT(reference.err, HasSubstr("reference:athlete"));
  EXPECT_EQ(sinewProgram({"retarget", "--shape", "hulk"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(model));
}

/// Ctrl-C once the program says what it is at: in order, soon, and no file.
void interruptAt(const std::string& work) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "shape.json", R"({"femur_r": {"elongation": 1.3}, "humerus_l": {"elongation": 0.7},
    "trunk": {"elongation": 1.3}, "neck": {"elongation": 0.7}})");
  const auto model = folder / "body.json";
  test::Program program{{SINEW_EXECUTABLE, "retarget", "--shape", (folder / "shape.json").string(), "--method",
                         "paper", "-o", model.string()}};
  const auto begun = std::chrono::steady_clock::now();
  while (program.errSoFar().find(work) == std::string::npos &&
         std::chrono::steady_clock::now() - begun < std::chrono::seconds{60})
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  ::kill(program.pid(), SIGINT);
  const auto asked = std::chrono::steady_clock::now();
  const auto result = program.wait();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - asked;
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_THAT(result.out, HasSubstr("cancelled"));
  EXPECT_LT(seconds.count(), 1);  // 0.2 s on a machine that has nothing else to do
  EXPECT_FALSE(std::filesystem::exists(model));
}

TEST(CliRetarget, IsInterruptedWhilePreparing) {
  interruptAt("preparing");
}

TEST(CliRetarget, IsInterruptedWhileRouting) {
  interruptAt("routing");
}

TEST(CliExperiment, WritesJsonAndFigures) {
  const test::TemporaryFolder folder;
  const auto result = sinewProgram({"experiment", "popliteal", "--out", folder.path().string(), "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = documentOf(result);
  EXPECT_EQ(document["format"], "sinew.experiments");
  ASSERT_EQ(document["experiments"].size(), 1u);
  const Json& popliteal = document["experiments"][0];
  EXPECT_EQ(popliteal["verdicts"][0]["paper"], "30 deg");
  EXPECT_EQ(popliteal["verdicts"][0]["met"], true);
  EXPECT_NEAR(popliteal["result"]["rows"][0]["angle_deg"].get<double>(), 30, 2);
  EXPECT_THAT(readFile(folder / "popliteal.svg"), HasSubstr("<svg"));
  EXPECT_TRUE(readFile(folder / "popliteal.png").starts_with("\x89PNG"));
  EXPECT_EQ(parseJson(readFile(folder / "popliteal.json"), "file")["result"], popliteal["result"]);
}

TEST(CliExperiment, QuickRangeOfMotion) {
  const test::TemporaryFolder folder;
  const auto result = sinewProgram({"experiment", "rom-preservation", "--quick", "--out", folder.path().string()});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("1.7 %"), HasSubstr("5.8-75.4 %")));
  EXPECT_TRUE(std::filesystem::exists(folder / "rom-preservation.png"));
}

TEST(CliExperiment, UnknownOnesAreAnsweredWithTheNearest) {
  const auto result = sinewProgram({"experiment", "disorder"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("disorders"), HasSubstr("rom-preservation")));
}

}  // namespace
}  // namespace sinew
