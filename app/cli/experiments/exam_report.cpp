#include <algorithm>

#include "app/cli/experiments/experiment.h"
#include "app/cli/support/text_table.h"
#include "app/plot/paint_figure.h"
#include "clinical/exam/exam_study.h"

namespace sinew {
namespace {

constexpr double kSteepest_per_deg = 0.02;  // asked
constexpr double kStepBack = 1e-4;          // of a factor: the solver's tolerance
constexpr unsigned kSeed = 2026;

std::string figureOf(const std::vector<FactorCurve>& curves, const ClinicalTests& tests, const std::string& title) {
  Figure figure{title, "measured angle [deg]", {}};
  for (const FactorCurve& c : curves) {
    FigurePanel panel{tests.group(c.group).title};
    panel.curves.push_back(curveOver(c.measured_deg, c.factor, tests.test(c.test).title, 0));
    figure.panels.push_back(std::move(panel));
  }
  return svgOf(figure);
}

std::vector<std::vector<std::string>> curveRows(const std::vector<FactorCurve>& curves) {
  std::vector<std::vector<std::string>> rows;
  for (const FactorCurve& c : curves) {
    const auto [least, most] = std::ranges::minmax(c.factor);
    rows.push_back({c.test, c.group, fixed(c.measured_deg.front(), 0) + " ... " + fixed(c.measured_deg.back(), 0),
                    fixed(least, 3) + " ... " + fixed(most, 3), fixed(c.largest_slope_per_deg, 4),
                    c.largest_step_back < kStepBack ? "yes" : "by " + fixed(c.largest_step_back, 5)});
  }
  return rows;
}

std::vector<std::string> randomRow(const std::string& option, const RandomExams& r) {
  std::string reasons;
  for (const auto& [reason, count] : r.reasons)
    reasons += (reasons.empty() ? "" : "; ") + std::to_string(count) + " " + reason;
  return {option,
          std::to_string(r.exams),
          std::to_string(r.tests),
          std::to_string(r.off),
          std::to_string(r.unnamed),
          std::to_string(r.not_solved),
          reasons};
}

}  // namespace

ExperimentReport examReport(ExperimentContext& context) {
  Session& session = context.session();
  const Model model = session.model("reference");
  const ClinicalTests tests = loadClinicalTests(session.resourceDir(), model.skeleton);
  const Examiner examiner{model, tests, {.mass_kg = tests.reference_mass_kg}};
  const double step_deg = context.quick() ? 5 : 1;
  const int exams = context.quick() ? 10 : 200;
  ExperimentReport report{.outcome = Outcome::Converged};
  std::vector<std::vector<std::string>> random;
  double steepest = 0, back = 0;
  int unnamed = 0;
  for (const bool leave : {true, false}) {
    if (context.job().cancelled()) return {.outcome = Outcome::Cancelled};
    const std::string option = leave ? "left inside the norm" : "solved inside the norm too";
    const auto curves = factorCurves(examiner, leave, step_deg);
    for (const FactorCurve& c : curves) {
      steepest = std::max(steepest, c.largest_slope_per_deg);
      back = std::max(back, c.largest_step_back);
    }
    report.text +=
        option + "\n" +
        textTable({"test", "group", "measured deg", "factor", "steepest, 1/deg", "monotone"}, curveRows(curves)) +
        "\n";
    report.figures.push_back({leave ? "exam-factors" : "exam-factors-in-norm",
                              figureOf(curves, tests, "Length factor over the measured angle, " + option)});
    const RandomExams r = randomExams(examiner, leave, exams, kSeed);
    unnamed += r.unnamed;
    random.push_back(randomRow(option, r));
  }
  report.text +=
      textTable({"random examinations", "", "tests", "off > 1 deg", "without a reason", "not solved", "why"}, random);
  report.verdicts = {
      {"steepest change of a factor", "-", "< 0.02 per deg", fixed(steepest, 4), steepest < kSteepest_per_deg},
      {"factor against the measurement", "-", "monotone", back < kStepBack ? "monotone" : fixed(back, 5),
       back < kStepBack},
      {"residuals above 1 deg without a reason", "-", "0", std::to_string(unnamed), unnamed == 0}};
  report.result = {{"steepest_per_deg", steepest}, {"largest_step_back", back}, {"unnamed", unnamed}};
  return report;
}

}  // namespace sinew
