#include <algorithm>
#include <cmath>
#include <set>

#include "clinical/report/figure_texts.h"
#include "clinical/report/judgement.h"
#include "clinical/report/report_tables.h"

namespace sinew {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double k95 = 1.96;

int decimalsOf(const std::string& unit) {
  return unit == "mm" ? 0 : 1;
}

const BoneFigure* find(const SkeletonFit& fit, const std::string& quantity, const std::string& side) {
  const auto it = std::ranges::find_if(fit.figures,
                                       [&](const BoneFigure& f) { return f.quantity == quantity && f.side == side; });
  return it == fit.figures.end() ? nullptr : &*it;
}

bool usable(const BoneFigure* f) {
  return f && f->determined && std::isfinite(f->value);
}

std::string valueText(const BoneFigure* f) {
  if (!f || !std::isfinite(f->value)) return kNotMeasured;
  if (!f->determined) return kUndetermined;
  const int decimals = decimalsOf(f->unit);
  return numberText(f->value, decimals) + " (" + numberText(f->lower95, decimals) + " to " +
         numberText(f->upper95, decimals) + ")" + (f->triangulated ? " \u00A7" : "");
}

double sdOf(const BoneFigure& f) {
  return (f.upper95 - f.lower95) / (2 * k95);
}

/// Right minus left; marked if it is larger than the measurement error of a difference.
std::string differenceText(const BoneFigure* left, const BoneFigure* right) {
  if (!usable(left) || !usable(right)) return left || right ? kUndetermined : kNotMeasured;
  const double difference = right->value - left->value;
  const bool real = std::abs(difference) > k95 * std::hypot(sdOf(*left), sdOf(*right));
  return signedText(difference, decimalsOf(left->unit)) + (real ? " *" : "");
}

std::string judgement(const BoneFigure* f, const Norm& norm) {
  if (!usable(f) || !norm.comparable) return {};
  return markOf(judge(f->value, f->lower95, f->upper95, norm.mean, norm.sd));
}

std::string normText(const std::optional<Norm>& norm, const std::string& unit) {
  if (!norm) return kNoNorm;
  std::string text = numberText(norm->mean, decimalsOf(unit));
  text += std::isfinite(norm->sd) ? "\u00A0\u00B1\u00A0" + numberText(norm->sd, decimalsOf(unit)) : " (no SD)";
  if (!norm->comparable) text += "\u00A0\u2020";
  if (!norm->verified) text += "\u00A0\u2021";
  return text;
}

}  // namespace

ReportTable boneTable(const SkeletonFit& fit, const NormTable& norms, const NormQuery& who) {
  ReportTable table;
  table.title = "Bones";
  table.columns = {"Figure (convention)",  "Unit",         "Right (95 % interval)",
                   "Left (95 % interval)", "Right - left", "Norm for age, sex, height"};
  std::set<std::string> shown;
  for (const auto& figure : fit.figures) {
    if (!shown.insert(figure.quantity).second) continue;
    const auto text = norms.textOf(figure.quantity);
    const auto norm = norms.normOf(figure.quantity, who);
    std::vector<std::string> row{headingOf(text), figure.unit};
    std::array<double, 2> z{kNaN, kNaN};
    const auto score = [&](const BoneFigure* f) { return norm && usable(f) ? norm->zScore(f->value) : kNaN; };
    const auto judged = [&](const BoneFigure* f) { return valueText(f) + (norm ? judgement(f, *norm) : ""); };
    if (figure.side.empty()) {
      row.insert(row.end(), {judged(&figure), kSpan, "midline"});
      z[0] = score(&figure);
    } else {
      const auto *left = find(fit, figure.quantity, "l"), *right = find(fit, figure.quantity, "r");
      row.insert(row.end(), {judged(right), judged(left), differenceText(left, right)});
      z = {score(right), score(left)};
    }
    row.push_back(normText(norm, figure.unit));
    if (norm)
      table.sources.push_back(text.title + ": " + norm->source + (norm->note.empty() ? "" : " (" + norm->note + ")"));
    table.rows.push_back(std::move(row));
    table.z_scores.push_back(z);
  }
  table.footnote =
      "* difference beyond its measurement error (95 %). \u25B2 \u25BC more than 2 SD above or below the norm, "
      "beyond the "
      "measurement error. \u2020 norm by another definition: no z-score. \u2021 norm not yet verified at its source. "
      "undetermined: the images do not show it.";
  const auto from_picks = triangulatedTexts(fit.figures, norms);
  if (!from_picks.empty())
    table.footnote +=
        " \u00A7 a bone is outside the model of the software: the figure is that of the picks themselves.";
  for (const auto& text : from_picks) table.footnote += " " + text + ".";
  return table;
}

ReportTable definitionTable(const SkeletonFit& fit, const NormTable& norms) {
  ReportTable table;
  table.title = "Definitions of the bone figures";
  table.columns = {"Figure", "Unit", "Sign", "Definition"};
  std::set<std::string> shown;
  for (const auto& figure : fit.figures) {
    if (!shown.insert(figure.quantity).second) continue;
    const auto text = norms.textOf(figure.quantity);
    table.rows.push_back({text.title, figure.unit, text.convention.empty() ? "as defined" : text.convention,
                          text.definition.empty() ? "see the software's documentation" : text.definition});
  }
  table.footnote =
      "All figures come from the skeleton fitted to the landmarks in both views, in the posture of the radiographs; "
      "95 % intervals from the covariance of that fit. Those marked \u00A7 come from the landmarks themselves "
      "(triangulated), because no bone of the model follows them.";
  return table;
}

}  // namespace sinew
