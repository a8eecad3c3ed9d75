#include "core/file.h"
#include "core/model/model.h"
#include "core/text.h"
#include "tests/app/cli/cli_support.h"

namespace sinew {
namespace {

using test::documentOf;
using test::ProgramResult;
using test::sinewProgram;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(CliModel, InfoOfTheReferenceGivesItsPublishedCounts) {
  const ProgramResult result = sinewProgram({"model", "info", "reference", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json info = documentOf(result);
  const std::map<std::string, int> published = {{"segments", 23}, {"moving_bodies", 19}, {"joints", 18},
                                                {"revolute", 5},  {"ball", 13},          {"coordinates", 50},
                                                {"muscles", 282}};
  for (const auto& [name, count] : published) EXPECT_EQ(info[name], count) << name;
  EXPECT_NEAR(info["mass_kg"].get<double>(), 73, 0.005);
}

TEST(CliModel, AuditOfTheReferenceHasNoOutliers) {
  const ProgramResult result = sinewProgram({"model", "audit", "reference", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  const Json audit = documentOf(result);
  EXPECT_EQ(audit["outliers"], 0);
  EXPECT_EQ(audit["units"].size(), 282u);
  EXPECT_EQ(audit["findings"].size(), audit["explained"].get<std::size_t>());
  for (const auto& finding : audit["findings"]) EXPECT_FALSE(finding["reason"].get<std::string>().empty());
  const ProgramResult text = sinewProgram({"model", "audit", "reference", "--all"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("F_max N"), HasSubstr("Explained: "), HasSubstr(" 0 outliers\n")));
}

TEST(CliModel, AuditNamesAForceThatSlipped) {
  const test::TemporaryFolder folder;
  Model model = loadReferenceModel(test::resourceDir());
  model.musculature.units[0].max_isometric_force_N *= 10;
  saveModel(model, folder / "model.json");
  const ProgramResult result = sinewProgram({"model", "audit", folder / "model.json"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("Outlier: "), HasSubstr("psoas_major_superior_r"), HasSubstr("psoas_major_*_r")));
}

TEST(CliModel, MomentArmsJudgesTablesOfOthers) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "arms.csv",
                      "muscle,dof,pose_other_dofs,angle_deg,reference_cm,accept_min_cm,accept_max_cm\n"
                      "soleus_medial,ankle_dorsiflexion,,0,-4.5,-6,-3\n"
                      "soleus_medial,ankle_dorsiflexion,knee_flexion=90,0,4.5,3,6\n");
  const ProgramResult result = sinewProgram({"model", "moment-arms", "reference", "--reference", folder / "arms.csv",
                                             "--functions", test::testDataDir() / "muscle_functions.csv", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json judged = documentOf(result);
  EXPECT_EQ(judged["moment_arms"]["inside"], 1);
  EXPECT_EQ(judged["moment_arms"]["wrong_sign"], 1);
  EXPECT_EQ(judged["moment_arms"]["listed"][0]["where"], "arms.csv: line 3");
  EXPECT_EQ(judged["functions"]["principal"]["rows"], 177);
  const ProgramResult text = sinewProgram({"model", "moment-arms", "reference", "--reference", folder / "arms.csv"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("wrong sign"), HasSubstr("moment arms inside: 50.0 % (1 of 2)")));
  EXPECT_THAT(sinewProgram({"model", "moment-arms", "reference"}).err, HasSubstr("--functions"));
}

TEST(CliModel, EvaluateSaysWhatActivationsCanTurn) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "postures.json").string();
  writeFileAtomically(file, R"([{"name":"standing","coordinates_deg":{}}])");
  const std::vector<std::string> command = {"evaluate", "reference", "--postures", file, "--what", "controllability"};
  std::vector<std::string> with_json = command;
  with_json.push_back("--json");
  const Json controls = documentOf(sinewProgram(with_json))["postures"][0]["controllability"];
  EXPECT_EQ(controls.size(), 44u);
  EXPECT_LT(controls["knee_flexion_r"]["increasing_residual"].get<double>(), 0.01);
  EXPECT_GT(controls["knee_flexion_r"]["decreasing_strength_Nm"].get<double>(), 100);
  EXPECT_THAT(sinewProgram(command).out,
              HasSubstr("standing,controllability,knee_flexion_r,increasing_strength_Nm,"));
}

TEST(CliModel, TheReferenceIsValidAndDamageIsNot) {
  const ProgramResult good = sinewProgram({"model", "validate", "reference", "--json"});
  EXPECT_EQ(good.status, 0) << good.out;
  EXPECT_EQ(documentOf(good)["valid"], true);
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "model.json", R"({"format":"sinew.model","version":99})");
  const ProgramResult future = sinewProgram({"model", "validate", folder / "model.json", "--json"});
  EXPECT_EQ(future.status, 2);
  EXPECT_THAT(documentOf(future)["error"]["message"].get<std::string>(), HasSubstr("99"));
}

TEST(CliModel, EvaluateObeysTheLawsOfAMechanism) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "postures.json").string();
  // Two postures 0.02 deg apart: the arm is the slope of the length, -dl/dtheta.
  writeFileAtomically(file, R"([{"name":"a","coordinates_deg":{"knee_flexion_r":39.99}},
                               {"name":"b","coordinates_deg":{"knee_flexion_r":40.01}},
                               {"name":"m","coordinates_deg":{"knee_flexion_r":40}}])");
  const ProgramResult result =
      sinewProgram({"evaluate", "reference", "--postures", file, "--what",
                    "lengths,moment_arms,validity,limiting_muscle,passive_torque", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json postures = documentOf(result)["postures"];
  ASSERT_EQ(postures.size(), 3u);
  EXPECT_EQ(postures[2]["lengths_m"].size(), 282u);
  EXPECT_TRUE(postures[2]["valid"].is_boolean());
  EXPECT_FALSE(postures[2]["limiting"].empty());
  int spanning = 0;
  for (const auto& [muscle, arms] : postures[2]["moment_arms_m"].items()) {
    if (!arms.contains("knee_flexion_r")) continue;
    ++spanning;
    const double difference_m =
        postures[1]["lengths_m"][muscle].get<double>() - postures[0]["lengths_m"][muscle].get<double>();
    const double arm_m = -difference_m / (0.02 * 3.14159265358979 / 180);
    EXPECT_NEAR(arms["knee_flexion_r"].get<double>(), arm_m, 1e-6)
        << muscle;  // central difference of a smooth length
  }
  EXPECT_GT(spanning, 10);
}

TEST(CliModel, EvaluateAnswersWrongNames) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "postures.json").string();
  writeFileAtomically(file, R"([{"name":"a","coordinates_deg":{"knee_flexin_r":10}}])");
  const ProgramResult coordinate = sinewProgram({"evaluate", "reference", "--postures", file});
  EXPECT_EQ(coordinate.status, 2);
  EXPECT_THAT(coordinate.err, AllOf(HasSubstr("postures.json: [0]"), HasSubstr("knee_flexion_r")));
  const ProgramResult quantity = sinewProgram({"evaluate", "reference", "--postures", file, "--what", "length"});
  EXPECT_EQ(quantity.status, 2);
  EXPECT_THAT(quantity.err, HasSubstr("nearest: lengths"));
}

TEST(CliModel, EvaluateGivesTheIsometricTorqueOfBothWays) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "postures.json").string();
  writeFileAtomically(file, R"([{"name":"sitting","coordinates_deg":{"knee_flexion_r":60,"hip_flexion_r":60}}])");
  const ProgramResult result =
      sinewProgram({"evaluate", "reference", "--postures", file, "--what", "peak_torque", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json knee = documentOf(result)["postures"][0]["peak_torque_Nm"]["knee_flexion_r"];
  // Strong young men extend with 150-350 N m (isometric, seated); the sum of all flexors is below that of extensors.
  EXPECT_LT(knee["decreasing"].get<double>(), -100);
  EXPECT_GT(knee["decreasing"].get<double>(), -450);
  EXPECT_GT(knee["increasing"].get<double>(), 40);
  EXPECT_LT(knee["increasing"].get<double>(), -knee["decreasing"].get<double>());
}

TEST(CliModel, EvaluateNamesAFieldThatIsMissing) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "postures.json").string();
  writeFileAtomically(file, R"([{"coordinates_deg":{}}])");
  EXPECT_THAT(sinewProgram({"evaluate", "reference", "--postures", file}).err, HasSubstr("[0].name: "));
}

TEST(CliModel, EvaluatePrintsCsvForPeople) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "postures.json").string();
  writeFileAtomically(file, R"([{"name":"up, right","coordinates_deg":{}}])");
  const ProgramResult result = sinewProgram({"evaluate", "reference", "--postures", file, "--what", "lengths"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("posture,quantity,name,coordinate,value\n\"up, right\",lengths_m,"));
  EXPECT_EQ(std::ranges::count(result.out, '\n'), 283);
}

TEST(CliModel, CurveComesInFourForms) {
  const test::TemporaryFolder folder;
  const std::vector<std::string> command = {"curve",           "reference", "--muscle",
                                            "soleus_medial_r", "--motion",  "ankle_dorsiflexion"};
  auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = command;
    all.insert(all.end(), more.begin(), more.end());
    return sinewProgram(all);
  };
  const ProgramResult json = with({"--json", "--samples", "11"});
  ASSERT_EQ(json.status, 0) << json.err;
  const Json curve = documentOf(json);
  EXPECT_EQ(curve["theta"].size(), 11u);
  EXPECT_EQ(curve["theta"][10], 1.0);
  for (const auto& arm : curve["moment_arm_m"]) EXPECT_LT(arm.get<double>(), 0);  // the soleus points the foot
  EXPECT_THAT(with({}).out, StartsWith("theta,angle_deg,length_m,moment_arm_m"));
  ASSERT_EQ(with({"-o", folder / "c.svg"}).status, 0);
  EXPECT_THAT(readFile(folder / "c.svg"), AllOf(StartsWith("<svg"), HasSubstr("moment arm [mm]")));
  ASSERT_EQ(with({"-o", folder / "c.png"}).status, 0);
  EXPECT_THAT(readFile(folder / "c.png"), StartsWith("\x89PNG"));
  EXPECT_EQ(with({"-o", folder / "c.bmp"}).status, 2);
  const ProgramResult wrong = sinewProgram({"curve", "reference", "--muscle", "soleus", "--motion", "knee_flexion"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("soleus"));
}

TEST(CliModel, ResourcesThatAreNotThereAreNamed) {
  const ProgramResult result = sinewProgram({"model", "info", "reference", "--resources", "/nowhere"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("/nowhere"));
}

TEST(CliModel, TheExaminationOfAModelIsSimulatedWithoutAForm) {
  const ProgramResult result = sinewProgram({"exam", "reference", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json tests = documentOf(result)["tests"];
  EXPECT_GE(tests.size(), 4u);
  for (const auto& test : tests) {
    EXPECT_TRUE(test["measured_deg"].is_null());
    EXPECT_TRUE(test["simulated_before_deg"].is_number()) << test["test"];
  }
}

}  // namespace
}  // namespace sinew
