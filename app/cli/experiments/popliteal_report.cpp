#include "app/cli/experiments/experiment.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/popliteal.h"
#include "app/plot/paint_figure.h"

namespace sinew {
namespace {

std::string figureOf(const std::vector<PoplitealRow>& rows) {
  FigurePanel panel{"moment against extension [N m]"};
  panel.highest = 2 * kPoplitealThreshold_Nm;  // beyond nobody looks
  for (const PoplitealRow& row : rows)
    panel.curves.push_back({row.body, row.moment_Nm, static_cast<LineRole>(panel.curves.size() % 5)});
  return svgOf({"Net passive moment as the knee is extended, hip at 90 deg", "lack of extension [deg]", {panel}});
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
