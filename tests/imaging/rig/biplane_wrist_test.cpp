// A real biplane pair: calibration and beads of the Brown Biomechanics sample data, found by hand.
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "core/file.h"
#include "core/text.h"
#include "imaging/rig/triangulate.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

struct WristBeads {
  std::vector<Sighting> sightings;
  std::vector<Eigen::Vector3d> p_WB;
};

WristBeads readBeads(const std::filesystem::path& file) {
  WristBeads beads;
  std::istringstream in{readFile(file)};
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("#") || line.starts_with("bead")) continue;
    const auto cells = splitCsvLine(line);
    const auto number = [&](std::size_t i) { return parseNumber(cells[i], file.string(), cells[0]); };
    for (int view : {0, 1})
      beads.sightings.push_back(
          {cells[0], view, {number(1 + 2 * std::size_t(view)), number(2 + 2 * std::size_t(view))}, 0.5});
    beads.p_WB.emplace_back(1e-3 * number(5), 1e-3 * number(6), 1e-3 * number(7));
  }
  return beads;
}

BiplanarRig importWrist(const std::filesystem::path& folder) {
  return importTextCalibration(std::vector{folder / "xr_calib_wrist_cam01.txt", folder / "xr_calib_wrist_cam02.txt"},
                               "autoscoper");
}

TEST(BiplaneWrist, BeadsAreFoundWhereTheyAre) {
  SINEW_NEEDS_EXTERNAL("biplane_wrist");
  const BiplanarRig rig = importWrist(external_file);
  // The optical axes are 110.0 deg apart; the rays at the middle of the images, off the principal points, within 1.5.
  EXPECT_NEAR(angleBetweenViews_rad(rig) * 180 / M_PI, 110.0, 1.5);
  const WristBeads beads = readBeads(external_file / "beads.csv");
  const Triangulation result = triangulateAll(rig, beads.sightings);
  ASSERT_EQ(result.points.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((result.points[i].p_WL - beads.p_WB[i]).norm(), 0.2e-3) << result.points[i].name;
    EXPECT_LT(result.points[i].reprojection_rms_px, 0.5) << result.points[i].name;
    RecordProperty(result.points[i].name + "_error_mm",
                   std::to_string(1e3 * (result.points[i].p_WL - beads.p_WB[i]).norm()));
  }
  EXPECT_THAT(result.warnings, testing::IsEmpty());
  if (std::getenv("SINEW_PRINT_RESIDUALS"))
    for (std::size_t i = 0; i < 4; ++i)
      std::printf("bead %s: %.4f mm, %.3f px\n", result.points[i].name.c_str(),
                  1e3 * (result.points[i].p_WL - beads.p_WB[i]).norm(), result.points[i].reprojection_rms_px);
}

TEST(BiplaneWrist, RowsCountedFromBelowAreNamed) {
  SINEW_NEEDS_EXTERNAL("biplane_wrist");
  const BiplanarRig rig = importWrist(external_file);
  for (int flipped : {0, 1, 2}) {
    auto sightings = readBeads(external_file / "beads.csv").sightings;
    for (auto& s : sightings)
      if (flipped == 2 || s.view == flipped) s.uv_px.y() = 1759 - s.uv_px.y();
    const auto result = triangulateAll(rig, sightings);
    ASSERT_FALSE(result.warnings.empty());
    EXPECT_EQ(result.warnings.back().code, "flipped_y") << "case " << flipped;
    EXPECT_THAT(result.warnings.back().message,
                testing::HasSubstr(flipped == 2 ? "both views" : "view " + std::to_string(flipped + 1)));
  }
}

}  // namespace
}  // namespace sinew
