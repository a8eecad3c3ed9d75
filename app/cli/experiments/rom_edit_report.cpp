#include "app/cli/experiments/experiment.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/rom_edit_experiment.h"
#include "app/plot/svg_charts.h"

namespace sinew {
namespace {

constexpr double kTarget = 0.05;

Json cellsJson(const RomEditCells& c) {
  return {{"held", c.held},
          {"cells", c.cells},
          {"differing", c.differing},
          {"of_all", c.ofAll()},
          {"of_union", c.ofUnion()},
          {"of_all_in_stops", c.ofAllInStops()},
          {"of_union_in_stops", c.ofUnionInStops()}};
}

Json cellsJson(const std::vector<RomEditCells>& cells) {
  Json list = Json::array();
  for (const RomEditCells& c : cells) list.push_back(cellsJson(c));
  return list;
}

std::string title(const RomEditExperimentRow& row) {
  return row.reference + ", " + inWords(row.edits.front());
}

std::vector<Verdict> verdictsOf(const RomEditExperiment& found) {
  std::vector<Verdict> verdicts;
  for (const RomEditExperimentRow& row : found.rows) {
    if (row.edits != found.rows.front().edits) continue;  // the paper's edit, of either reference
    const auto add = [&](const std::string& what, double paper, double sinew) {
      verdicts.push_back({row.reference + ", hip tilted 30 deg, cone x 0.63: " + what, "7.3 %", "<= 5 %",
                          percentText(sinew, 2) + " (the paper's way " + percentText(paper, 2) + ")",
                          sinew <= kTarget});
    };
    const RomEditCells &paper = row.paper.front(), &sinew = row.sinew.front();
    add("of all cells, muscles alone", paper.ofAll(), sinew.ofAll());
    add("of the union, muscles alone", paper.ofUnion(), sinew.ofUnion());
    add("of all cells, with stops", paper.ofAllInStops(), sinew.ofAllInStops());
    add("of the union, with stops", paper.ofUnionInStops(), sinew.ofUnionInStops());
  }
  return verdicts;
}

std::string tableOf(const RomEditExperiment& found) {
  std::vector<std::vector<std::string>> rows;
  for (const RomEditExperimentRow& row : found.rows) {
    const RomEditCells &paper = row.paper.front(), &sinew = row.sinew.front();
    rows.push_back({title(row), percentText(paper.ofAll(), 2), percentText(sinew.ofAll(), 2),
                    percentText(paper.ofUnion()), percentText(sinew.ofUnion()), percentText(paper.ofUnionInStops()),
                    percentText(sinew.ofUnionInStops()), std::to_string(row.sinew_changed.size())});
  }
  return textTable(
             {"edit", "of all, paper", "sinew", "of union, paper", "sinew", "with stops, paper", "sinew", "units"},
             rows) +
         "Cells that are not as the edit asks, all other joints at zero; units whose lengths changed.\n";
}

std::string figureOf(const RomEditExperiment& found) {
  BarPanel panel{"of the cells valid in either, with stops", {}, {{}, {}}};
  for (const RomEditExperimentRow& row : found.rows) {
    panel.names.push_back(row.edits.front().joint + ", row " + std::to_string(panel.names.size() + 1) +
                          (row.reference == "reference" ? "" : ", athlete"));
    panel.values[0].push_back(100 * row.paper.front().ofUnionInStops());
    panel.values[1].push_back(100 * row.sinew.front().ofUnionInStops());
  }
  return barsSvg("Edited ranges of motion: cells that are not as wanted", "cells [%]", {"paper's way", "sinew"},
                 {panel}, 40);
}

}  // namespace

ExperimentReport romEditReport(ExperimentContext& context) {
  const RomEditExperiment found = romEditExperiment(context.session().resourceDir(), context.job());
  if (found.outcome != Outcome::Converged) return {.outcome = found.outcome};
  Json rows = Json::array();
  for (const RomEditExperimentRow& row : found.rows) {
    Json changed = Json::array();
    for (const RomEditChange& c : row.sinew_changed)
      changed.push_back({{"muscle", c.unit}, {"length_factor", c.length_factor}});
    rows.push_back({{"reference", row.reference},
                    {"edit", inWords(row.edits.front())},
                    {"paper", cellsJson(row.paper)},
                    {"sinew", cellsJson(row.sinew)},
                    {"changed", changed}});
  }
  return {.outcome = Outcome::Converged,
          .verdicts = verdictsOf(found),
          .text = tableOf(found),
          .result = {{"rows", rows}},
          .figures = {{"rom-edit", figureOf(found)}}};
}

}  // namespace sinew
