#include "app/cli/experiments/experiment.h"
#include "app/cli/svg_charts.h"
#include "app/cli/text_table.h"
#include "app/scene/rom_sphere.h"
#include "core/experiments/pose_dependence.h"

#include <algorithm>

namespace sinew {
namespace {

double widest_rad(const RomMap& map) {
  double widest = 0;
  for (int p = 0; p < RomMap::kPolars; ++p)
    for (int a = 0; a < RomMap::kAzimuths; ++a) widest = std::max(widest, map.twistWidth_rad(p, a));
  return widest;
}

/// The straightest and the most flexed knee, muscles alone and with stops, one colour scale.
std::string drawn(const std::vector<PoseDependenceRow>& rows, Session& session) {
  const PoseDependenceRow* ends[] = {&rows.front(), &rows.back()};
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
  const auto rows = poseDependence(context.session().reference());
  std::vector<std::vector<std::string>> table;
  Json list = Json::array();
  for (const PoseDependenceRow& row : rows) {
    table.push_back({fixed(row.knee_flexion_deg, 0) + " deg", std::to_string(row.muscles.validCount()),
                     std::to_string(row.with_stops.validCount()), fixed(row.flexion_deg, 0)});
    list.push_back({{"knee_flexion_deg", row.knee_flexion_deg},
                    {"valid_muscles", row.muscles.validCount()},
                    {"valid_with_stops", row.with_stops.validCount()},
                    {"hip_flexion_deg", row.flexion_deg}});
  }
  // Every straight knee (up to 30 deg) against every flexed one (from 90 deg on).
  int straight = 0, flexed = RomMap::kCells, straight_stops = 0, flexed_stops = RomMap::kCells;
  for (const PoseDependenceRow& row : rows) {
    if (row.knee_flexion_deg <= 30) {
      straight = std::max(straight, row.muscles.validCount());
      straight_stops = std::max(straight_stops, row.with_stops.validCount());
    } else {
      flexed = std::min(flexed, row.muscles.validCount());
      flexed_stops = std::min(flexed_stops, row.with_stops.validCount());
    }
  }
  const auto verdict = [](const std::string& what, int least, int most) {
    return Verdict{what, "wider", "wider", std::to_string(least) + " > " + std::to_string(most) + " cells",
                   least > most};
  };
  ExperimentReport report{
      .outcome = Outcome::Converged,
      .verdicts = {verdict("knee >= 90 deg against <= 30 deg, muscles alone", flexed, straight),
                   verdict("the same with stops", flexed_stops, straight_stops)},
      .text = textTable({"knee flexion", "cells, muscles alone", "with stops", "hip flexion deg"}, table) +
              "Valid cells of " + std::to_string(RomMap::kCells) +
              "; hip flexion straight forward. The narrowest flexed against the widest straight knee.\n",
      .result = {{"joint", "hip_r"}, {"cells", RomMap::kCells}, {"rows", list}}};
  const std::string picture = drawn(rows, context.session());
  if (!picture.empty()) report.figures = {{"pose-dependence", picture}};
  return report;
}

}  // namespace sinew
