#include "core/file.h"
#include "core/text.h"
#include "tests/app/cli/cli_support.h"

namespace sinew {
namespace {

using test::documentOf;
using test::ProgramResult;
using test::sinewProgram;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(CliGeometry, ImportsTheWristCalibrationAndTriangulatesItsBeads) {
  SINEW_NEEDS_EXTERNAL("biplane_wrist/beads.csv");
  const test::TemporaryFolder folder;
  const auto data = external_file.parent_path();
  const std::string rig = (folder / "rig.json").string(), picks = (folder / "picks.csv").string();
  const ProgramResult imported =
      sinewProgram({"rig", "import", "--format", "autoscoper", data / "xr_calib_wrist_cam01.txt",
                    data / "xr_calib_wrist_cam02.txt", "-o", rig, "--json"});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_NEAR(documentOf(imported)["angle_between_views_deg"].get<double>(), 110, 1.5);  // stated with the data
  EXPECT_FALSE(documentOf(imported)["patient_aligned"].get<bool>());

  writeFileAtomically(picks, test::wristSightings(external_file));
  const ProgramResult result = sinewProgram({"triangulate", "--rig", rig, "--sightings", picks, "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = documentOf(result);
  EXPECT_EQ(document["format"], "sinew.triangulation");
  EXPECT_LT(document["rms_px"].get<double>(), 0.5);
  ASSERT_EQ(document["points"].size(), 4u);
  std::istringstream in{readFile(external_file)};
  std::string line;
  std::size_t i = 0;
  while (std::getline(in, line)) {
    const auto cells = splitCsvLine(line);
    if (cells.size() != 8 || cells[0] == "bead") continue;
    const Json& point = document["points"][i++];
    EXPECT_EQ(point["name"], cells[0]);
    for (std::size_t axis = 0; axis < 3; ++axis)  // 0.2 mm: twice the stated accuracy of the table
      EXPECT_NEAR(point["p_mm"][axis].get<double>(), parseNumber(cells[5 + axis], "beads", "mm"), 0.2);
  }
}

TEST(CliGeometry, AFileOfSightingsIsNamedWithItsLine) {
  const test::TemporaryFolder folder;
  const std::string picks = (folder / "picks.csv").string();
  writeFileAtomically(picks, "name,view,u_px,v_px\nA,1,10,20\nA,0,11,20\n");
  Json rig = parseJson(R"({"format":"sinew.rig","version":1,"patient_aligned":true,"views":[
    {"projection":"orthographic","width_px":9,"height_px":9,"R_CW":[[0,0,1],[0,-1,0],[1,0,0]],"p_CW_m":[0,0,0],
     "column_spacing_m":0.001,"row_spacing_m":0.001,"u0_px":0,"v0_px":0},
    {"projection":"orthographic","width_px":9,"height_px":9,"R_CW":[[1,0,0],[0,-1,0],[0,0,-1]],"p_CW_m":[0,0,0],
     "column_spacing_m":0.001,"row_spacing_m":0.001,"u0_px":0,"v0_px":0}]})",
                       "test");
  writeFileAtomically(folder / "rig.json", jsonText(rig));
  const auto complaint = [&] {
    const ProgramResult result =
        sinewProgram({"triangulate", "--rig", folder / "rig.json", "--sightings", picks, "--json"});
    EXPECT_EQ(result.status, 2);
    return documentOf(result)["error"]["message"].get<std::string>();
  };
  EXPECT_THAT(complaint(), AllOf(HasSubstr("picks.csv: line 3"), HasSubstr("view: expected 1, 2, ..., found '0'")));
  // How many views there are the rig knows, not the file.
  writeFileAtomically(picks, "name,view,u_px,v_px\nA,1,10,20\nA,3,11,20\n");
  EXPECT_THAT(complaint(), HasSubstr("A: expected a view from 1 to 2, found view 3"));

  writeFileAtomically(picks, "name,view,u_px,v_px\nA,1,10,20\nA,2,30,20\n");
  const ProgramResult good = sinewProgram({"triangulate", "--rig", folder / "rig.json", "--sightings", picks});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("1 points"));
  // Orthographic by hand: z = u1 - u0 = 10 mm, x = u2 - u0 = 30 mm, y = -(v - v0) = -20 mm.
  const Json point = documentOf(sinewProgram(
      {"triangulate", "--rig", folder / "rig.json", "--sightings", picks, "--json", "--quiet"}))["points"][0];
  EXPECT_NEAR(point["p_mm"][0].get<double>(), 30, 1e-6);
  EXPECT_NEAR(point["p_mm"][1].get<double>(), -20, 1e-6);
  EXPECT_NEAR(point["p_mm"][2].get<double>(), 10, 1e-6);
}

}  // namespace
}  // namespace sinew
