#include <signal.h>

#include <Eigen/Core>
#include <chrono>
#include <thread>

#include "core/file.h"
#include "core/text.h"
#include "tests/app/cli/cli_support.h"

namespace sinew {
namespace {

using test::documentOf;
using test::ProgramResult;
using test::sinewProgram;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// The demo patient, made once for all tests of this file.
struct Demo {
  test::TemporaryFolder folder;
  ProgramResult result;
  std::string path() const { return (folder / "case").string(); }
};

const Demo& demo() {
  static const Demo* made = [] {
    auto* d = new Demo;
    d->result = sinewProgram({"demo", "--out", d->path(), "--seed", "5", "--binning", "2", "--json"});
    return d;
  }();
  return *made;
}

/// A copy of the demo case that a test may change.
std::string copyOfDemo(const test::TemporaryFolder& folder) {
  const auto copy = folder / "copy";
  std::filesystem::copy(demo().path(), copy, std::filesystem::copy_options::recursive);
  return copy.string();
}

std::vector<std::string> stageValues(const Json& document, const std::string& member) {
  std::vector<std::string> values;
  for (const auto& stage : document["stages"]) values.push_back(stage[member]);
  return values;
}

TEST(CliCase, DemoGoesTheWholeWayAndStatesItsTruth) {
  ASSERT_EQ(demo().result.status, 0) << demo().result.err;
  const Json document = documentOf(demo().result);
  EXPECT_EQ(document["format"], "sinew.demo");
  EXPECT_EQ(stageValues(document, "name"), (std::vector<std::string>{"images", "calibration", "landmarks", "skeleton",
                                                                     "musculature", "exam", "report"}));
  EXPECT_THAT(stageValues(document, "outcome"), Each(std::string{"converged"}));
  EXPECT_THAT(readFile(document["files"]["report"].get<std::string>()), StartsWith("%PDF"));
  EXPECT_EQ(documentOf(sinewProgram({"model", "validate", document["files"]["model"], "--json"}))["valid"], true);
  EXPECT_THAT(demo().result.err, AllOf(HasSubstr("rendering view 1: rays through the body\n"),
                                       HasSubstr("fitting shape and posture\n")));
  const auto skeleton = demo().result.err.find("\nSkeleton\n");  // a title is said once, not again at its end
  EXPECT_EQ(demo().result.err.find("\nSkeleton\n", skeleton + 1), std::string::npos);
  int within = 0, all = 0;
  for (const auto& row : document["truth_comparison"]) {
    if (row["lower95"].is_null()) continue;
    ++all;
    within += row["lower95"] <= row["truth"] && row["truth"] <= row["upper95"];
  }
  EXPECT_GT(all, 10);
  EXPECT_GE(within, all * 8 / 10);  // 95 % each, correlated within one patient
}

TEST(CliCase, ARunOfAFinishedCaseDoesNothing) {
  const test::TemporaryFolder folder;
  const std::string copy = copyOfDemo(folder);
  const std::string before = readFile(copy + "/case.json");
  const ProgramResult result = sinewProgram({"run", copy});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("up to date"), HasSubstr("truth"), HasSubstr("report.pdf")));
  EXPECT_EQ(readFile(copy + "/case.json"), before);
}

TEST(CliCase, StaleStagesAreSaidAndRunAgain) {
  const test::TemporaryFolder folder;
  const std::string copy = copyOfDemo(folder);
  Json c = parseJson(readFile(copy + "/case.json"), "case");
  c["sightings"][0]["u_px"] = c["sightings"][0]["u_px"].get<double>() + 1;
  writeFileAtomically(copy + "/case.json", jsonText(c));
  const Json status = documentOf(sinewProgram({"status", copy, "--json"}));
  EXPECT_EQ(stageValues(status, "state"),
            (std::vector<std::string>{"done", "done", "stale", "stale", "stale", "stale", "stale"}));

  const ProgramResult refused = sinewProgram({"report", copy, "--json"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(documentOf(refused)["error"]["found"].get<std::string>(), HasSubstr("Landmarks: stale"));

  const ProgramResult again = sinewProgram({"run", copy, "--to", "skeleton", "--json"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(stageValues(documentOf(again), "outcome"),
            (std::vector<std::string>{"done", "done", "converged", "converged"}));
}

TEST(CliCase, DamageIsReported) {
  const test::TemporaryFolder folder;
  const std::string copy = copyOfDemo(folder);
  writeFileAtomically(copy + "/results/model.json", "{}");
  const ProgramResult status = sinewProgram({"status", copy});
  EXPECT_EQ(status.status, 0);
  EXPECT_THAT(status.out, HasSubstr("damaged: results/model.json"));
  const std::string text = readFile(copy + "/case.json");
  std::filesystem::remove(copy + "/images/view2.dcm");
  const ProgramResult without_image = sinewProgram({"run", copy});  // although every stage is done
  EXPECT_EQ(without_image.status, 2);
  EXPECT_THAT(without_image.err, HasSubstr("view2.dcm: expected a file of the case"));
  EXPECT_EQ(readFile(copy + "/case.json"), text);
  writeFileAtomically(copy + "/case.json", text.substr(0, text.size() / 2));
  const ProgramResult broken = sinewProgram({"run", copy});
  EXPECT_EQ(broken.status, 2);
  EXPECT_THAT(broken.err, AllOf(HasSubstr("case.json: line "), HasSubstr("cut off")));
  EXPECT_EQ(readFile(copy + "/case.json"), text.substr(0, text.size() / 2));
}

/// Exact picks of the demo phantom's beads, through the calibrated geometry of the case.
std::string exactBeadPicks(const Json& rig) {
  std::istringstream beads{readFile(demo().path() + "/calibration/beads.csv")};
  std::string picks = "name,view,u_px,v_px\n", line;
  std::getline(beads, line);
  while (std::getline(beads, line)) {
    const auto cells = splitCsvLine(line);
    for (int i = 0; i < 2; ++i) {
      const Json& view = rig["views"][std::size_t(i)];
      Eigen::Vector3d p_C;
      for (std::size_t row = 0; row < 3; ++row) {
        p_C[int(row)] = view["p_CW_m"][row];
        for (std::size_t axis = 0; axis < 3; ++axis)
          p_C[int(row)] += view["R_CW"][row][axis].get<double>() * parseNumber(cells[axis + 1], "beads", "mm") / 1000;
      }
      picks += cells[0] + "," + std::to_string(i + 1) + "," +
               std::to_string(view["fx_px"].get<double>() * p_C.x() / p_C.z() + view["cx_px"].get<double>()) + "," +
               std::to_string(view["fy_px"].get<double>() * p_C.y() / p_C.z() + view["cy_px"].get<double>()) + "\n";
    }
  }
  return picks;
}

TEST(CliCase, PickedBeadsGiveTheGeometryBack) {
  const test::TemporaryFolder folder;
  const Json rig = parseJson(readFile(demo().path() + "/case.json"), "case")["results"]["rig"];
  writeFileAtomically(folder / "picks.csv", exactBeadPicks(rig));
  const std::string calibration = demo().path() + "/calibration/";
  const ProgramResult result =
      sinewProgram({"rig", "calibrate", "--image", calibration + "phantom_view1.dcm", "--image",
                    calibration + "phantom_view2.dcm", "--beads", calibration + "beads.csv", "--sightings",
                    folder / "picks.csv", "-o", folder / "rig.json", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_LT(documentOf(result)["rms_px"].get<double>(), 0.01);  // exact picks; printed to 1e-6 px
  const Json back = parseJson(readFile(folder / "rig.json"), "rig");
  for (std::size_t i = 0; i < 2; ++i)  // 0.1 % of the focal length: what beads known to 0.05 mm leave open
    EXPECT_NEAR(back["views"][i]["fx_px"].get<double>() / rig["views"][i]["fx_px"].get<double>(), 1, 1e-3);
}

TEST(CliCase, ADemoNeverOverwritesOtherFiles) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "thesis.txt", "years of work");
  const ProgramResult result = sinewProgram({"demo", "--out", folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("other files, which are kept"));
  EXPECT_EQ(readFile(folder / "thesis.txt"), "years of work");
  const ProgramResult rig = sinewProgram({"demo", "--rig", "slotscan"});
  EXPECT_EQ(rig.status, 2);
  EXPECT_THAT(rig.err, HasSubstr("nearest: slot-scan"));
}

TEST(CliCase, NewMakesACaseFromTheFilesOfAnother) {
  const test::TemporaryFolder folder;
  const std::string made = (folder / "made").string();
  const std::string from = demo().path();
  const ProgramResult result = sinewProgram(
      {"new", made, "--image", from + "/images/view1.dcm", "--image", from + "/images/view2.dcm", "--mass-kg", "70"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json c = parseJson(readFile(made + "/case.json"), "case");
  EXPECT_EQ(c["images"][0]["sha256"], sha256OfFile(from + "/images/view1.dcm"));
  EXPECT_EQ(c["patient"]["mass_kg"], 70.0);
  EXPECT_FALSE(c["patient"]["id"].get<std::string>().empty());  // from the DICOM file
  EXPECT_THAT(result.out + result.err, Not(HasSubstr(c["patient"]["name"].get<std::string>())));
  const ProgramResult again =
      sinewProgram({"new", made, "--image", from + "/images/view1.dcm", "--image", from + "/images/view2.dcm"});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("not overwritten"));

  // No landmark was picked: a run goes as far as it can; asking for more is an error.
  const ProgramResult run = sinewProgram({"run", made});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("no landmark has been picked"));
  const ProgramResult more = sinewProgram({"run", made, "--to", "skeleton", "--json"});
  EXPECT_EQ(more.status, 2);
  EXPECT_THAT(documentOf(more)["error"]["message"].get<std::string>(), HasSubstr("no landmark has been picked"));
  EXPECT_EQ(documentOf(more)["stages"].size(), 2u);
}

TEST(CliCase, NewLeavesNothingBehindWhenItRefuses) {
  const test::TemporaryFolder folder;
  const std::string made = (folder / "made").string(), image = demo().path() + "/images/view1.dcm";
  const ProgramResult twice = sinewProgram({"new", made, "--image", image, "--image", image});
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("the same image twice"));
  const ProgramResult tall = sinewProgram(
      {"new", made, "--image", image, "--image", demo().path() + "/images/view2.dcm", "--height-m", "175"});
  EXPECT_EQ(tall.status, 2);
  EXPECT_THAT(tall.err, HasSubstr("patient: height [m]: expected 0.3 to 2.7, found 175"));
  EXPECT_FALSE(std::filesystem::exists(made));
}

TEST(CliCase, ThePatientIsStatedAtFirstAndChangedAtAnyTime) {
  const test::TemporaryFolder folder;
  const std::string made = (folder / "made").string(), from = demo().path();
  const auto new_case = [&](const std::string& birth_date) {
    return sinewProgram({"new", made, "--image", from + "/images/view1.dcm", "--image", from + "/images/view2.dcm",
                         "--sex", "f", "--birth-date", birth_date, "--height", "1.28", "--mass", "23.5"});
  };
  for (const char* wrong : {"2014-02-31", "00000000", "2199-01-01", "soon"}) {
    const ProgramResult refused = new_case(wrong);
    EXPECT_EQ(refused.status, 2) << wrong;
    EXPECT_THAT(refused.err, HasSubstr("birth date")) << wrong;
    EXPECT_FALSE(std::filesystem::exists(made));
  }
  ASSERT_EQ(new_case("20140309").status, 0);
  const Json stored = parseJson(readFile(made + "/case.json"), "case")["patient"];
  EXPECT_EQ(stored["sex"], "F");
  EXPECT_EQ(stored["birth_date"], "2014-03-09");

  const std::string copy = copyOfDemo(folder);
  const std::string before = readFile(copy + "/case.json");
  const Json shown = documentOf(sinewProgram({"patient", copy, "--json"}));
  EXPECT_FALSE(shown["patient"].contains("name"));
  EXPECT_EQ(readFile(copy + "/case.json"), before);  // to look is not to change
  const Json changed = documentOf(sinewProgram({"patient", copy, "--mass-kg", "54", "--json"}));
  EXPECT_EQ(changed["patient"]["mass_kg"], 54.0);
  EXPECT_THAT(changed["stale"].get<std::vector<std::string>>(), ::testing::Contains("exam"));
  EXPECT_THAT(changed["stale"].get<std::vector<std::string>>(), Not(::testing::Contains("skeleton")));
  const Json taken_back = documentOf(sinewProgram({"patient", copy, "--mass", "unknown", "--json"}));
  EXPECT_TRUE(taken_back["patient"]["mass_kg"].is_null());
  EXPECT_EQ(sinewProgram({"patient", copy, "--mass", "5400"}).status, 2);
  EXPECT_EQ(sinewProgram({"patient", copy, "--birth-date", "2099-01-01"}).status, 2);
}

TEST(CliCase, StatusNamesTheReferenceDataAndNoticesAnother) {
  const test::TemporaryFolder folder;
  const auto resources = folder / "resources";
  std::filesystem::copy(test::resourceDir(), resources, std::filesystem::copy_options::recursive);
  const auto states = [&] {
    return stageValues(documentOf(sinewProgram({"status", demo().path(), "--resources", resources, "--json"})),
                       "state");
  };
  EXPECT_THAT(states(), Each(std::string{"done"}));
  writeFileAtomically(resources / "clinical/norms.json", readFile(resources / "clinical/norms.json") + "\n");
  EXPECT_EQ(states(), (std::vector<std::string>{"done", "done", "done", "done", "done", "done", "stale"}));
  const Json status = documentOf(sinewProgram({"status", demo().path(), "--json"}));
  bool named = false;
  for (const auto& use : status["resources"]) named |= use["path"] == "clinical/norms.json";
  EXPECT_TRUE(named);
}

TEST(CliCase, AReportOfACaseThatCanOnlyBeReadIsCopied) {
  const test::TemporaryFolder folder;
  const std::string copy = copyOfDemo(folder);
  const std::string before = readFile(copy + "/case.json");
  const auto file = folder / "report.pdf";
  const ProgramResult result = sinewProgram({"report", copy, "-o", file});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(readFile(file), readFile(copy + "/results/report.pdf"));
  EXPECT_EQ(readFile(copy + "/case.json"), before);  // nothing was written into the case
}

TEST(CliCase, ALostAnswerIsAFailure) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const std::string program = SINEW_EXECUTABLE;
  const int status =
      std::system(("'" + program + "' status '" + demo().path() + "' --json > /dev/full 2>/dev/null").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
}

TEST(CliCase, WrongStageNamesAreAnsweredWithTheNearest) {
  const ProgramResult result = sinewProgram({"run", demo().path(), "--to", "skelton"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("nearest: skeleton"));
}

TEST(CliCase, RunTriangulatesTheRealWristPair) {
  SINEW_NEEDS_EXTERNAL("biplane_wrist/beads.csv");
  const auto data = external_file.parent_path();
  const test::TemporaryFolder folder;
  const std::string rig = (folder / "rig.json").string(), picks = (folder / "picks.csv").string();
  const std::string made = (folder / "wrist").string();
  writeFileAtomically(picks, test::wristSightings(external_file));
  ASSERT_EQ(sinewProgram({"rig", "import", "--format", "autoscoper", data / "xr_calib_wrist_cam01.txt",
                          data / "xr_calib_wrist_cam02.txt", "-o", rig})
                .status,
            0);
  const ProgramResult created =
      sinewProgram({"new", made, "--image", data / "xr_rad_uln_cam01_UND.0099.tif", "--image",
                    data / "xr_rad_uln_cam02_UND.0099.tif", "--rig", rig, "--sightings", picks});
  ASSERT_EQ(created.status, 0) << created.err;
  const ProgramResult run = sinewProgram({"run", made, "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(
      stageValues(documentOf(run), "outcome"),
      (std::vector<std::string>{"converged", "converged", "converged", "missing", "blocked", "blocked", "blocked"}));
  const Json landmarks = parseJson(readFile(made + "/case.json"), "case")["results"]["landmarks"];
  EXPECT_EQ(landmarks["points"].size(), 4u);
  EXPECT_LT(landmarks["rms_px"].get<double>(), 0.5);
  const ProgramResult further = sinewProgram({"run", made, "--to", "skeleton"});
  EXPECT_EQ(further.status, 2);
  EXPECT_THAT(further.err, HasSubstr("no known landmark of the skeleton"));
}

TEST(CliCase, AnInterruptEndsInOrder) {
  const test::TemporaryFolder folder;
  test::Program program{{SINEW_EXECUTABLE, "demo", "--out", folder / "case"}};
  for (int i = 0; i < 600 && program.errSoFar().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::kill(program.pid(), SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.status, 3) << result.err;
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path(), error))
    EXPECT_THAT(entry.path().filename().string(), Not(StartsWith("."))) << "a temporary file was left";
}

}  // namespace
}  // namespace sinew
