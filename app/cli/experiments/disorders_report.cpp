#include <algorithm>
#include <numeric>

#include "app/cli/experiments/experiment.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/disorders.h"
#include "app/plot/paint_figure.h"
#include "app/plot/svg_charts.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

long countReversed(const std::vector<double>& shares) {
  return std::ranges::count_if(shares, [](double share) { return share > 0; });
}

/// Units by share, largest first: of either method.
std::vector<std::size_t> worstUnits(const DisorderRow& row, std::size_t count, bool right_only,
                                    const std::vector<std::string>& units) {
  std::vector<std::size_t> order;
  const auto worse = [&](std::size_t u) { return std::max(row.naive[u], row.retargeted[u]); };
  for (std::size_t u = 0; u < units.size(); ++u)
    if (worse(u) > 0 && !(right_only && units[u].ends_with("_l"))) order.push_back(u);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return worse(a) > worse(b); });
  order.resize(std::min(order.size(), count));
  return order;
}

bool isMild(const DisorderRow& row) {
  return row.elongation >= 0.8 && row.elongation <= 1.3;
}

struct Worse {
  std::size_t unit;
  const DisorderRow* row;
  double by() const { return row->retargeted[unit] - row->naive[unit]; }
};

/// Where the retargeted muscle reverses more than the one that rides on its bones; the most first.
std::vector<Worse> worseThanNaive(const Disorders& found) {
  std::vector<Worse> worse;
  for (const DisorderRow& row : found.rows)
    for (std::size_t u = 0; u < found.units.size(); ++u)
      if (row.retargeted[u] > row.naive[u]) worse.push_back({u, &row});
  std::ranges::stable_sort(worse, [](const Worse& a, const Worse& b) { return a.by() > b.by(); });
  return worse;
}

std::vector<Verdict> verdictsOf(const Disorders& found) {
  double naive = 0, retargeted = 0, mild = 0, rows = double(found.rows.size());
  long mild_units = 0;
  for (const DisorderRow& row : found.rows) {
    naive += mean(row.naive) / rows, retargeted += mean(row.retargeted) / rows;
    if (!isMild(row)) continue;
    mild = std::max(mild, *std::ranges::max_element(row.retargeted));
    mild_units += countReversed(row.retargeted);
  }
  const auto worse = worseThanNaive(found);
  return {{"reversed steps, mean of all units and limbs", "much reduced", "reported",
           percentText(naive, 2) + " -> " + percentText(retargeted, 2), std::nullopt},
          {"units worse than without retargeting, all limbs", "", "none",
           std::to_string(worse.size()) + " of " + std::to_string(found.rows.size() * found.units.size()) +
               (worse.empty() ? "" : ", by at most " + percentText(worse.front().by())),
           worse.empty()},
          {"limbs of 80-130 %: largest share of a unit", "alleviated", "0",
           percentText(mild) + " (" + std::to_string(mild_units) + " units)", mild == 0}};
}

std::string textOf(const Disorders& found) {
  std::vector<std::vector<std::string>> rows;
  for (const DisorderRow& row : found.rows)
    rows.push_back({percentText(row.elongation, 0), std::to_string(countReversed(row.naive)),
                    std::to_string(countReversed(row.retargeted)), percentText(mean(row.naive), 2),
                    percentText(mean(row.retargeted), 2), percentText(*std::ranges::max_element(row.naive)),
                    percentText(*std::ranges::max_element(row.retargeted))});
  std::string text =
      textTable({"limbs", "units", "retargeted", "mean share", "retargeted", "largest", "retargeted"}, rows);
  for (const DisorderRow& row : found.rows) {
    const auto worst = worstUnits(row, 12, true, found.units);
    if (worst.empty()) continue;
    text += "limbs of " + percentText(row.elongation, 0) + ":";
    for (const std::size_t u : worst)
      text += " " + found.units[u] + " " + fixed(100 * row.naive[u], 0) + "->" + fixed(100 * row.retargeted[u], 0);
    text += "\n";
  }
  const auto worse = worseThanNaive(found);
  if (!worse.empty()) text += "worse than without, the most:";
  for (std::size_t i = 0; i < std::min<std::size_t>(worse.size(), 10); ++i)
    text += " " + found.units[worse[i].unit] + " at " + percentText(worse[i].row->elongation, 0) + " (" +
            fixed(100 * worse[i].row->naive[worse[i].unit], 1) + "->" +
            fixed(100 * worse[i].row->retargeted[worse[i].unit], 1) + ")";
  return text + (worse.empty() ? "" : "\n") +
         "Share of the steps of a unit's length-angle curves that go the other way than in the reference; right side "
         "listed.\n";
}

Json resultJson(const Disorders& found, int steps) {
  Json rows = Json::array();
  for (const DisorderRow& row : found.rows) {
    Json units = Json::array();
    for (std::size_t u = 0; u < found.units.size(); ++u)
      if (row.naive[u] > 0 || row.retargeted[u] > 0)
        units.push_back(
            {{"unit", found.units[u]}, {"naive_share", row.naive[u]}, {"retargeted_share", row.retargeted[u]}});
    rows.push_back({{"elongation", row.elongation},
                    {"naive_mean_share", mean(row.naive)},
                    {"retargeted_mean_share", mean(row.retargeted)},
                    {"units", units}});
  }
  return {{"steps", steps}, {"rows", rows}};
}

std::string barsOf(const Disorders& found) {
  std::vector<BarPanel> panels;
  for (const DisorderRow* row : {&found.rows.front(), &found.rows.back()}) {
    BarPanel panel{"limbs of " + percentText(row->elongation, 0), {}, {{}, {}}};
    for (const std::size_t u : worstUnits(*row, 20, true, found.units)) {
      panel.names.push_back(found.units[u]);
      panel.values[0].push_back(100 * row->naive[u]);
      panel.values[1].push_back(100 * row->retargeted[u]);
    }
    panels.push_back(std::move(panel));
  }
  return barsSvg("Functional disorders: reversed share of the length-angle curves", "reversed steps [%]",
                 {"without retargeting", "retargeted"}, panels, 100);
}

std::string curvesOf(const Disorders& found) {
  FigureCurve naive{"without retargeting", {}}, retargeted{"retargeted", {}, LineRole::Second};
  for (const DisorderRow& row : found.rows) {
    naive.points.emplace_back(100 * row.elongation, 100 * mean(row.naive));
    retargeted.points.emplace_back(100 * row.elongation, 100 * mean(row.retargeted));
  }
  return svgOf({"Functional disorders over the length of the limbs",
                "length of the limb bones [%]",
                {{"reversed steps, mean of all units [%]", {naive, retargeted}}}});
}

}  // namespace

ExperimentReport disordersReport(ExperimentContext& context) {
  DisorderOptions options;
  if (context.quick()) options.elongations = {0.8, 1.3};
  const Disorders found = disorders(context.reference(), options, context.job());
  if (found.outcome != Outcome::Converged) return {.outcome = found.outcome};
  return {.outcome = Outcome::Converged,
          .verdicts = verdictsOf(found),
          .text = textOf(found),
          .result = resultJson(found, options.steps),
          .figures = {{"disorders", barsOf(found)}, {"disorders-curve", curvesOf(found)}}};
}

}  // namespace sinew
