#include "core/file.h"
#include "core/model/model.h"
#include "core/muscle/muscle_path.h"
#include "tests/app/cli/cli_support.h"
#include "tests/support/osim_text.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using test::documentOf;
using test::ProgramResult;
using test::sinewProgram;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A muscle that bends an elbow: 3 cm and 4 cm from the axis when it is at a right angle.
std::string elbow() {
  return test::osimDocument(
      {.bodies = test::osimBody("upper") + test::osimBody("fore"),
       .joints = test::osimJoint("WeldJoint", "shoulder", "/ground", "/bodyset/upper", {}) +
                 test::osimJoint("PinJoint", "elbow", "/bodyset/upper", "/bodyset/fore", {"flexion"}),
       .constraints = "",
       .forces = "<CoordinateActuator name=\"motor\"/>" +
                 test::osimMuscle("flexor", test::osimPoint("/bodyset/upper", "0 0.3 0") +
                                                test::osimPoint("/bodyset/fore", "0 -0.04 0"))});
}

class CliExchange : public ::testing::Test {
 protected:
  void SetUp() override { writeFileAtomically(file_, elbow()); }
  std::string path(const char* name) const { return (folder_ / name).string(); }

  test::TemporaryFolder folder_;
  std::string file_ = path("elbow.osim");
};

TEST_F(CliExchange, ImportSaysWhatWasReadAndStoresIt) {
  const ProgramResult result = sinewProgram({"import", file_, "-o", path("elbow.json"), "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json info = documentOf(result);
  EXPECT_EQ(info["muscles"], 1);
  EXPECT_EQ(info["coordinates"], 1);
  EXPECT_EQ(info["warnings"].size(), 1u);
  EXPECT_THAT(info["warnings"][0]["message"].get<std::string>(), HasSubstr("CoordinateActuator"));
  const ProgramResult again = sinewProgram({"import", path("elbow.json")});
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.out, HasSubstr("OpenSim 40000"));
}

TEST_F(CliExchange, EvaluateTakesTheFileAndWhatImportStored) {
  writeFileAtomically(path("postures.json"), R"([{"name":"bent","coordinates_deg":{"flexion":90}}])");
  sinewProgram({"import", file_, "-o", path("elbow.json"), "-q"});
  for (const auto& model : {file_, path("elbow.json")}) {
    const ProgramResult result =
        sinewProgram({"evaluate", model, "--postures", path("postures.json"), "--what",
                      "lengths,moment_arms,fiber_lengths,passive_forces,passive_torque,peak_torque", "--json", "-q"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json bent = documentOf(result)["postures"][0];
    const double length_m = std::hypot(0.3, 0.04);
    EXPECT_NEAR(bent["lengths_m"]["flexor"].get<double>(), length_m, 1e-12);
    EXPECT_NEAR(bent["moment_arms_m"]["flexor"]["flexion"].get<double>(), 0.3 * 0.04 / length_m, 1e-12);
    EXPECT_TRUE(bent["peak_torque_Nm"].contains("flexion"));
  }
  const auto complaint = [&](const std::string& what) {
    const ProgramResult refused =
        sinewProgram({"evaluate", file_, "--postures", path("postures.json"), "--what", what, "-q"});
    EXPECT_EQ(refused.status, 2);
    return refused.err;
  };
  EXPECT_THAT(complaint("validity"), HasSubstr("'validity'"));
  writeFileAtomically(path("postures.json"), R"([{"name":"bent","coordinates_deg":{"flexoin":90}}])");
  EXPECT_THAT(complaint("lengths"), AllOf(HasSubstr("postures.json"), HasSubstr("nearest: flexion")));
}

TEST_F(CliExchange, CurveTakesACoordinateAsMotion) {
  const ProgramResult result = sinewProgram({"curve", file_, "--muscle", "flexor", "--motion", "flexion=0:90",
                                             "--samples", "3", "-o", path("curve.svg"), "--json", "-q"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json curve = documentOf(result);
  EXPECT_EQ(curve["angle_deg"][2], 90.0);
  EXPECT_NEAR(curve["length_m"][0].get<double>(), 0.34, 1e-12);
  EXPECT_THAT(readFile(path("curve.svg")), HasSubstr("flexion [deg]"));
  const ProgramResult wrong = sinewProgram({"curve", file_, "--muscle", "flexor", "--motion", "elbow", "-q"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("flexion"));
}

TEST_F(CliExchange, DamagedFilesAreAnsweredWithTheLine) {
  writeFileAtomically(file_, "<OpenSimDocument Version=\"40000\">\n<Model>\n</OpenSimDocument>");
  const ProgramResult result = sinewProgram({"import", file_, "--json"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(documentOf(result)["error"]["where"].get<std::string>(), HasSubstr("elbow.osim: line 3"));
  EXPECT_EQ(sinewProgram({"import", "reference"}).status, 2);
  EXPECT_EQ(sinewProgram({"import", path("absent.osim")}).status, 2);
}

TEST_F(CliExchange, ExportsSayHowFarLengthsAreOff) {
  for (const std::string format : {"osim", "mjcf", "json"}) {
    const ProgramResult result =
        sinewProgram({"export", "reference", "--format", format, "-o", path("out.osim"), "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json deviation = documentOf(result)["deviation"];
    ASSERT_EQ(deviation["units"].size(), 282u);
    int exact = 0;
    for (const auto& unit : deviation["units"])
      exact += unit["max_norm_m"].get<double>() < 1e-4 && unit["max_random_m"].get<double>() < 1e-4;
    EXPECT_EQ(deviation["exact_units"], exact) << format;
    EXPECT_GE(exact, format == "json" ? 282 : 100) << format;
  }
  EXPECT_EQ(sinewProgram({"export", "reference", "--muscles", "millard", "-o", path("out.xml")}).status, 2);
}

TEST_F(CliExchange, AnExportCanBeEvaluatedWithItsMeshesBesideIt) {
  const ProgramResult made = sinewProgram(
      {"export", "reference", "--format", "osim", "--meshes", "--muscles", "millard", "-o", path("whole.osim")});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("within 0.1 mm"));
  const std::string text = readFile(path("whole.osim"));
  EXPECT_THAT(text, AllOf(HasSubstr("<mesh_file>femur_r.obj</mesh_file>"), HasSubstr("Millard2012EquilibriumMuscle"),
                          HasSubstr("within 0.1 mm")));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "Geometry" / "femur_r.obj"));
  writeFileAtomically(path("postures.json"), R"([{"name":"a","coordinates_deg":{"knee_flexion_r":60}}])");
  const auto arm = [&](const std::string& model) {
    const Json p = documentOf(sinewProgram({"evaluate", model, "--postures", path("postures.json"), "--what",
                                            "moment_arms", "--json", "-q"}))["postures"][0];
    return p["moment_arms_m"]["vastus_intermedius_medial_r"]["knee_flexion_r"].get<double>();
  };
  EXPECT_NEAR(arm(path("whole.osim")), arm("reference"), 1e-5);
}

}  // namespace
}  // namespace sinew
