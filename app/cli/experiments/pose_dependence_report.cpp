#include "app/cli/experiments/experiment.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/pose_dependence.h"
#include "app/plot/svg_charts.h"
#include "app/scene/rom_sphere.h"
#include "core/retarget/prepared/reference.h"

#include <algorithm>

namespace sinew {
namespace {

double widest_rad(const RomMap& map) {
  double widest = 0;
  for (int p = 0; p < RomMap::kPolars; ++p)
    for (int a = 0; a < RomMap::kAzimuths; ++a) widest = std::max(widest, map.twistWidth_rad(p, a));
  return widest;
}

/// A straight and a flexed knee, muscles alone and with stops, one colour scale.
std::string drawn(const PoseDependenceRow& straight, const PoseDependenceRow& flexed, Session& session) {
  const PoseDependenceRow* ends[] = {&straight, &flexed};
  std::vector<CaptionedPicture> pictures;
  try {
    for (const bool stops : {false, true}) {
      const auto map = [&](const PoseDependenceRow& row) -> const RomMap& {
        return stops ? row.with_stops : row.muscles;
      };
      RomPicture sphere;
      sphere.width_px = sphere.height_px = 380;
      sphere.widest_rad = std::max(widest_rad(map(*ends[0])), widest_rad(map(*ends[1])));
      for (const auto* row : ends)
        pictures.push_back(
            {renderRomSphere(map(*row), sphere),
             {"knee " + fixed(row->knee_flexion_deg, 0) + " deg, " + (stops ? "with stops" : "muscles alone"),
              std::to_string(map(*row).validCount()) + " cells"}});
    }
  } catch (const InputError& cannot_draw) {
    session.note(std::string{"no picture of the spheres: "} + cannot_draw.what());
    return "";
  }
  return picturesSvg("Where the right femur can point", pictures);
}

}  // namespace

ExperimentReport poseDependenceReport(ExperimentContext& context) {
  const auto rows = poseDependence(context.reference().model());
  std::vector<std::vector<std::string>> table;
  Json list = Json::array();
  for (const PoseDependenceRow& row : rows) {
    table.push_back({fixed(row.knee_flexion_deg, 0) + " deg", std::to_string(row.muscles.validCount()),
                     std::to_string(forwardCount(row.muscles)), std::to_string(row.with_stops.validCount()),
                     fixed(row.flexion_deg, 0)});
    list.push_back({{"knee_flexion_deg", row.knee_flexion_deg},
                    {"valid_muscles", row.muscles.validCount()},
                    {"forward_muscles", forwardCount(row.muscles)},
                    {"valid_with_stops", row.with_stops.validCount()},
                    {"hip_flexion_deg", row.flexion_deg}});
  }
  const PoseDependenceRow &straight = rows.front(), &flexed = rows[2];
  const auto verdict = [](const std::string& what, int wide, int narrow) {
    return Verdict{what, "wider", "wider", std::to_string(wide) + " against " + std::to_string(narrow),
                   wide > narrow};
  };
  ExperimentReport report{
      .outcome = Outcome::Converged,
      .verdicts = {verdict("cells, knee at 90 against 0 deg, with stops", flexed.with_stops.validCount(),
                           straight.with_stops.validCount()),
                   verdict("cells that point forward, muscles alone", forwardCount(flexed.muscles),
                           forwardCount(straight.muscles)),
                   verdict("hip flexion [deg]", int(flexed.flexion_deg), int(straight.flexion_deg)),
                   verdict("all cells, muscles alone", flexed.muscles.validCount(), straight.muscles.validCount())},
      .text =
          textTable({"knee flexion", "cells, muscles alone", "forward", "with stops", "hip flexion deg"}, table) +
          "Valid cells of " + std::to_string(RomMap::kCells) +
          "; forward: the shaft points in front of the joint. Backward, beyond the stops, a flexed knee narrows the "
          "range by the rectus femoris.\n",
      .result = {{"joint", "hip_r"}, {"cells", RomMap::kCells}, {"rows", list}}};
  const std::string picture = drawn(straight, flexed, context.session());
  if (!picture.empty()) report.figures = {{"pose-dependence", picture}};
  return report;
}

}  // namespace sinew
