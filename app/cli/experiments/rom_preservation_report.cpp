#include <algorithm>

#include "app/cli/experiments/experiment.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/rom_preservation.h"
#include "app/plot/svg_charts.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

struct Range {
  double least = 1e9, most = 0;
  void add(double value) { least = std::min(least, value), most = std::max(most, value); }
  std::string text() const { return fixed(100 * least, 1) + "-" + percentText(most); }
};

/// Errors over all bodies but the reference's own shape.
Range rangeOf(const RomPreservation& found, bool naive, const std::function<double(const RomErrors&)>& error,
              std::size_t knee = 0) {
  Range range;
  for (const RomPreservationRow& row : found.rows)
    if (row.elongation != 1 || row.torsion_deg != 0) range.add(error((naive ? row.naive : row.retargeted)[knee]));
  return range;
}

Json differenceJson(const RomDifference& d) {
  return {{"only_reference", d.only_first},
          {"only_body", d.only_second},
          {"of_all", d.ofAll()},
          {"of_union", d.ofUnion()}};
}

Json errorsJson(const RomErrors& errors) {
  return {{"muscles", differenceJson(errors.muscles)}, {"with_stops", differenceJson(errors.with_stops)}};
}

Json resultJson(const RomPreservation& found, const RomPreservationOptions& options) {
  Json rows = Json::array();
  for (const RomPreservationRow& row : found.rows)
    for (std::size_t k = 0; k < options.knee_flexions_deg.size(); ++k)
      rows.push_back({{"elongation", row.elongation},
                      {"torsion_deg", row.torsion_deg},
                      {"knee_flexion_deg", options.knee_flexions_deg[k]},
                      {"naive", errorsJson(row.naive[k])},
                      {"retargeted", errorsJson(row.retargeted[k])}});
  return {{"joint", options.joint},
          {"cells", RomMap::kCells},
          {"knee_flexions_deg", options.knee_flexions_deg},
          {"valid_muscles", found.valid_muscles},
          {"valid_with_stops", found.valid_with_stops},
          {"rows", rows}};
}

std::vector<Verdict> verdictsOf(const RomPreservation& found, const RomPreservationOptions& options) {
  const auto union_of = [](const RomErrors& e) { return e.muscles.ofUnion(); };
  const auto all_of = [](const RomErrors& e) { return e.muscles.ofAll(); };
  const auto union_stops = [](const RomErrors& e) { return e.with_stops.ofUnion(); };
  const auto all_stops = [](const RomErrors& e) { return e.with_stops.ofAll(); };
  constexpr double kTarget = 0.01;
  std::vector<Verdict> verdicts = {{"naive: error of the valid cells (union), muscles alone", "5.8-75.4 %",
                                    "reported", rangeOf(found, true, union_of).text(), std::nullopt},
                                   {"naive: error of all cells, muscles alone", "", "reported",
                                    rangeOf(found, true, all_of).text(), std::nullopt}};
  for (std::size_t k = 0; k < options.knee_flexions_deg.size(); ++k) {
    const std::string knee = ", knee " + fixed(options.knee_flexions_deg[k], 0) + " deg";
    const auto add = [&](const std::string& what, const auto& error) {
      const double most = rangeOf(found, false, error, k).most;
      verdicts.push_back({"retargeted: largest error " + what + knee, k == 0 ? "1.7 %" : "", "<= 1.0 %",
                          percentText(most, 2), most <= kTarget});
    };
    add("of the union, muscles alone", union_of);
    add("of the union, with stops", union_stops);
    add("of all cells, muscles alone", all_of);
    add("of all cells, with stops", all_stops);
  }
  return verdicts;
}

std::string tableOf(const RomPreservation& found) {
  std::vector<std::vector<std::string>> rows;
  for (const RomPreservationRow& row : found.rows) {
    const RomErrors &naive = row.naive.front(), &after = row.retargeted.front();
    rows.push_back({fixed(100 * row.elongation, 0) + " %, " + fixed(row.torsion_deg, 0) + " deg",
                    percentText(naive.muscles.ofUnion()), percentText(naive.with_stops.ofUnion()),
                    percentText(after.muscles.ofUnion(), 2), percentText(after.with_stops.ofUnion(), 2),
                    percentText(after.muscles.ofAll(), 2)});
  }
  return textTable({"femora", "naive", "with stops", "retargeted", "with stops", "of all cells"}, rows);
}

std::string figureOf(const RomPreservation& found, const RomPreservationOptions& options) {
  std::vector<std::string> columns, rows;
  for (const double torsion : options.torsions_deg) columns.push_back(fixed(torsion, 0));
  for (const double elongation : options.elongations) rows.push_back(fixed(100 * elongation, 0) + " %");
  std::vector<HeatPanel> panels;
  for (const bool stops : {false, true})
    for (const bool naive : {true, false}) {
      HeatPanel panel{std::string{naive ? "naive" : "retargeted"} + (stops ? ", with stops" : ", muscles alone"), {}};
      for (std::size_t r = 0; r < rows.size(); ++r) {
        auto& values = panel.values.emplace_back();
        for (std::size_t c = 0; c < columns.size(); ++c) {
          const RomPreservationRow& row = found.rows[r * columns.size() + c];
          const RomErrors& errors = (naive ? row.naive : row.retargeted).front();
          values.push_back(100 * (stops ? errors.with_stops : errors.muscles).ofUnion());
        }
      }
      panels.push_back(std::move(panel));
    }
  const double darkest = 100 * rangeOf(found, true, [](const RomErrors& e) { return e.muscles.ofUnion(); }).most;
  return heatMapSvg("Hip range of motion: cells that differ from the reference [% of those valid in either]",
                    "torsion [deg]", columns, "femur elongation", rows, panels, darkest);
}

}  // namespace

ExperimentReport romPreservationReport(ExperimentContext& context) {
  RomPreservationOptions options;
  if (context.quick()) options.elongations = {0.7, 1, 1.3}, options.torsions_deg = {-30, 30};
  const RomPreservation found = romPreservation(context.reference(), options, context.job());
  if (found.outcome != Outcome::Converged) return {.outcome = found.outcome};
  return {.outcome = Outcome::Converged,
          .verdicts = verdictsOf(found, options),
          .text = tableOf(found) + "Knee straight; of the cells valid in either map. The reference has " +
                  std::to_string(found.valid_muscles.front()) + " valid cells by its muscles, " +
                  std::to_string(found.valid_with_stops.front()) + " with stops, of " +
                  std::to_string(RomMap::kCells) + ": the paper's 75.4 % can only be a share of valid cells.\n",
          .result = resultJson(found, options),
          .figures = {{"rom-preservation", figureOf(found, options)}}};
}

}  // namespace sinew
