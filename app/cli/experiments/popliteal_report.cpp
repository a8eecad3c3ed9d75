#include <cmath>

#include "app/cli/experiments/experiment.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/popliteal.h"
#include "app/plot/svg_plot.h"

namespace sinew {
namespace {

std::string figureOf(const std::vector<PoplitealRow>& rows) {
  std::vector<double> angles_deg;
  std::vector<PlotLine> lines;
  for (const auto& [angle_deg, moment] : rows.front().moment_Nm) angles_deg.push_back(angle_deg);
  for (const PoplitealRow& row : rows) {
    PlotLine line{row.body, {}};
    // Beyond twice the threshold nobody looks.
    for (const auto& [angle_deg, moment] : row.moment_Nm)
      line.y.push_back(moment <= 2 * kPoplitealThreshold_Nm ? moment : NAN);
    lines.push_back(std::move(line));
  }
  return plotSvg("Net passive moment as the knee is extended, hip at 90 deg", "lack of extension [deg]", angles_deg,
                 {{"moment against extension [N m]", lines}});
}

}  // namespace

ExperimentReport poplitealReport(ExperimentContext& context) {
  Session& session = context.session();
  std::vector<PoplitealRow> rows;
  for (const char* name : {"reference", "reference:athlete"})
    rows.push_back(poplitealRow(session.resourceDir(), session.model(name), name));
  std::vector<std::vector<std::string>> table;
  Json list = Json::array();
  for (const PoplitealRow& row : rows) {
    table.push_back({row.body, fixed(row.angle_deg, 1), row.stopped_by_joint ? "joint" : "50 N m"});
    list.push_back(
        {{"body", row.body}, {"angle_deg", numberOrNull(row.angle_deg)}, {"stopped_by_joint", row.stopped_by_joint}});
  }
  const bool met = std::abs(rows.front().angle_deg - kPoplitealReference_deg) <= kPoplitealTolerance_deg;
  return {.outcome = Outcome::Converged,
          .verdicts = {{"unilateral popliteal angle at 50 N m", "30 deg", "30 +- 2 deg",
                        fixed(rows.front().angle_deg, 1) + " deg", met}},
          .text = textTable({"", "popliteal angle deg", "stopped by"}, table),
          .result = {{"threshold_Nm", kPoplitealThreshold_Nm}, {"rows", list}},
          .figures = {{"popliteal", figureOf(rows)}}};
}

}  // namespace sinew
