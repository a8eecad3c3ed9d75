#include "app/cli/experiments/experiment.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/moment_arm_curves.h"
#include "app/plot/paint_figure.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

constexpr double kMm = 1000;

/// Whether the body's mean is above (+1) or below (-1) the reference's; nullopt for a body that is not in the figure.
std::optional<int> against(const MomentArmFigure& figure, const std::string& body) {
  for (const MomentArmCurve& curve : figure.curves)
    if (curve.body == body) return curve.mean_m > figure.curves.front().mean_m ? 1 : -1;
  return std::nullopt;
}

std::string nameOf(const MomentArmQuestion& question) {
  return question.muscle.empty() ? "all of " + question.motion : question.muscle;
}

/// Of a hip extensor and a hip flexor: what the claim is about.
Verdict verdictOf(const std::vector<MomentArmFigure>& figures, const std::string& body, int wanted,
                  const std::string& what) {
  int as_claimed = 0;
  std::string ours;
  for (std::size_t i = 0; i < 2; ++i) {
    const MomentArmFigure& figure = figures[i];
    as_claimed += against(figure, body) == wanted;
    for (const MomentArmCurve& curve : figure.curves)
      if (curve.body == body)
        ours +=
            (i ? ", " : "") + nameOf(figure.question) + " x " + fixed(curve.mean_m / figure.curves.front().mean_m, 2);
  }
  return {body + ": " + what, wanted > 0 ? "larger" : "smaller", "shown", ours, as_claimed == 2};
}

/// The same bodies as they are before step 1, or routed by another method.
std::vector<Character> routedBy(RetargetMethod method, ExperimentContext& context,
                                std::span<const Character> characters) {
  std::vector<Character> routed;
  for (const Character& c : characters)
    routed.push_back({.body = c.body,
                      .retargeted = retarget(context.reference(), c.body.shape,
                                             {.method = method, .peak_torque = false}, context.job())});
  return routed;
}

/// Mean arm of every body over the reference's, by each method.
std::string methodsText(ExperimentContext& context, std::span<const Character> characters) {
  const std::vector<Character> naive = routedBy(RetargetMethod::Naive, context, characters),
                               paper = routedBy(RetargetMethod::Paper, context, characters);
  std::vector<std::string> header = {"over the reference's"};
  std::vector<std::vector<std::string>> table;
  std::vector<MomentArmQuestion> questions = paperMomentArms();
  for (const MomentArmQuestion& question : hipMomentArms()) questions.push_back(question);
  for (const MomentArmQuestion& question : questions) {
    std::vector<std::string>& row = table.emplace_back(1, nameOf(question));
    std::vector<MomentArmFigure> figures;
    for (const std::span<const Character> bodies : {std::span{naive}, std::span{paper}, characters})
      figures.push_back(momentArmFigure(context.reference(), bodies, question));
    for (std::size_t c = 1; c <= characters.size(); ++c)
      for (const MomentArmFigure& figure : figures)
        row.push_back("x " + fixed(figure.curves[c].mean_m / figure.curves.front().mean_m, 2));
  }
  for (const Character& c : characters)
    for (const char* method : {" naive", " paper", " sinew"}) header.push_back(c.body.name + method);
  return textTable(header, table);
}

}  // namespace

ExperimentReport momentArmsReport(ExperimentContext& context) {
  const auto* characters = context.characters();
  if (!characters) return {.outcome = Outcome::Cancelled};
  // The human is the reference itself.
  const std::span others{characters->data() + 1, characters->size() - 1};
  ExperimentReport report{.outcome = Outcome::Converged};
  std::vector<MomentArmFigure> figures;
  std::vector<std::vector<std::string>> table;
  Json list = Json::array();
  for (const MomentArmQuestion& question : paperMomentArms()) {
    const MomentArmFigure& figure = figures.emplace_back(momentArmFigure(context.reference(), others, question));
    FigurePanel panel{"moment arm [mm]"};
    std::vector<std::string> row = {question.muscle + ", " + figure.title};
    Json curves = Json::array();
    for (const MomentArmCurve& curve : figure.curves) {
      std::vector<double> arm_mm;
      for (const double arm_m : curve.arm_m) arm_mm.push_back(kMm * arm_m);
      panel.curves.push_back(curveOver(figure.angle_deg, arm_mm, curve.body, panel.curves.size()));
      row.push_back(fixed(kMm * curve.mean_m, 1));
      curves.push_back({{"body", curve.body}, {"mean_m", curve.mean_m}, {"arm_m", curve.arm_m}});
    }
    table.push_back(row);
    list.push_back({{"muscle", question.muscle},
                    {"motion", question.motion},
                    {"angle_deg", figure.angle_deg},
                    {"curves", curves}});
    report.figures.push_back({"moment-arms-" + question.muscle,
                              svgOf({question.muscle + ", " + figure.title, figure.coordinate + " [deg]", {panel}})});
  }
  std::vector<std::string> header = {"mean moment arm [mm]"};
  for (const MomentArmCurve& curve : figures.front().curves) header.push_back(curve.body);
  report.text =
      textTable(header, table) +
      std::string{
          "Means over the motion, positive = turns that way; parts of a muscle weighted by their maximal forces.\n"} +
      methodsText(context, others);
  std::vector<MomentArmFigure> groups;
  for (const MomentArmQuestion& question : hipMomentArms())
    groups.push_back(momentArmFigure(context.reference(), others, question));
  for (const auto& [body, wanted] : {std::pair{"alien", 1}, {"hulk", -1}, {"dwarf", -1}}) {
    report.verdicts.push_back(verdictOf(figures, body, wanted, "hip extensor and flexor"));
    report.verdicts.push_back(verdictOf(groups, body, wanted, "all hip extensors and flexors"));
  }
  report.result = {{"figures", list}};
  return report;
}

}  // namespace sinew
