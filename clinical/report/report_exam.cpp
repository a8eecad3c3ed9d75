#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "clinical/report/judgement.h"
#include "clinical/report/report_tables.h"
#include "core/rom/tests/clinical_sweep.h"

namespace sinew {
namespace {

std::string joined(const std::vector<std::string>& parts, const char* separator, const char* if_none) {
  std::string text;
  for (const auto& part : parts) text += (text.empty() ? "" : separator) + part;
  return text.empty() ? if_none : text;
}

std::string readable(std::string_view unit) {
  std::string text{withoutSide(unit)};
  std::ranges::replace(text, '_', ' ');
  return text;
}

const ExamEntry* entryOf(const PhysicalExam& exam, const ExamComparison& comparison) {
  for (const auto& entry : exam.entries)
    if (entry.test == comparison.test && entry.side == comparison.side) return &entry;
  return nullptr;
}

/// Something was entered for it on that side, be it only why it was not measured.
bool entered(const PhysicalExam& exam, const ExamComparison& comparison) {
  const auto* entry = entryOf(exam, comparison);
  return comparison.measured_deg || (entry && !entry->note.empty());
}

std::string measuredText(const ExamComparison& comparison, const PhysicalExam& exam) {
  if (comparison.measured_deg) return numberText(*comparison.measured_deg);
  const auto* entry = entryOf(exam, comparison);
  return entry && !entry->note.empty() ? std::string{kNotMeasured} + ": " + entry->note : kNotMeasured;
}

/// Verified marks are by test: the norm of the patient's age is one of its entries.
bool verified(const ClinicalTest& test, const ExamComparison& c) {
  return std::ranges::any_of(test.norms_by_age, [&](const AgeNorm& n) {
    return n.norm.verified && test.written_deg(n.norm.mean_deg) == c.norm_mean_deg && n.norm.sd_deg == c.norm_sd_deg;
  });
}

/// Marked like a bone: beyond 2 SD of the norm, and beyond the measurement error of one examiner.
std::string judgement(const ExamComparison& c, const ClinicalTest& test) {
  if (!c.measured_deg) return {};
  return markOf(judgeMeasured(*c.measured_deg, test.form->measurement_sd_deg, c.norm_mean_deg, c.norm_sd_deg));
}

std::string normText(const ClinicalTest& test, const ExamComparison& c) {
  if (!std::isfinite(c.norm_mean_deg)) return kNoNorm;
  return numberText(c.norm_mean_deg) +
         (std::isfinite(c.norm_sd_deg) ? "\u00A0\u00B1\u00A0" + numberText(c.norm_sd_deg) : "") +
         (verified(test, c) ? "" : "\u00A0\u2021");
}

std::string normSource(const ClinicalTest& test, const ExamComparison& c) {
  for (const auto& n : test.norms_by_age)
    if (test.written_deg(n.norm.mean_deg) == c.norm_mean_deg && n.norm.sd_deg == c.norm_sd_deg) return n.norm.source;
  return test.source;
}

/// What holds where the test ends, largest share first.
std::string limitText(const ExamComparison& comparison) {
  std::vector<std::string> names;
  for (const auto& limit : comparison.limited_by) {
    const bool unit = limit.ends_with("_r") || limit.ends_with("_l");
    names.push_back(limit.starts_with("stop of") ? "joint (bone, ligament)" : unit ? readable(limit) : limit);
  }
  return joined(names, ", ", "nothing within the sweep");
}

std::vector<const LengthGroup*> groupsOf(const ClinicalTests& protocol, std::string_view unit) {
  std::vector<const LengthGroup*> groups;
  for (const auto& group : protocol.groups)
    if (std::ranges::find(group.units, withoutSide(unit)) != group.units.end()) groups.push_back(&group);
  return groups;
}

const GroupFactor* factorOf(const ExamFit& fit, const LengthGroup& group, char side) {
  for (const auto& row : fit.groups)
    if (row.group == group.name && row.side == side) return &row;
  return nullptr;
}

std::string intervalText(const GroupFactor& row) {
  if (!std::isfinite(row.lower95)) return "no interval";
  return "(" + numberText(row.lower95, 2) + "\u2013" + numberText(row.upper95, 2) + ")";
}

std::string factorText(const ExamFit& fit, const LengthGroup& group, char side) {
  const auto* row = factorOf(fit, group, side);
  if (!row || !row->tested) return kNotMeasured;
  return numberText(row->factor, 2) + " " + intervalText(*row) + (row->determined ? "" : ", undetermined");
}

std::string fiberText(const ExamFit& fit, const LengthGroup& group) {
  const auto one = [&](char side) {
    const auto* row = factorOf(fit, group, side);
    return row && row->tested ? numberText(row->fiber_only_factor, 2) : std::string{"\u2013"};
  };
  const std::string text = one('r') + " / " + one('l');
  return text == "\u2013 / \u2013" ? kNotMeasured : text;
}

/// In the protocol's order, right before left.
std::vector<ExamComparison> inOrder(const ExamFit& fit, const ClinicalTests& protocol) {
  auto tests = fit.tests;
  const auto rank = [&](const ExamComparison& t) {
    const auto it = std::ranges::find(protocol.tests, t.test, &ClinicalTest::id);
    return std::pair{it - protocol.tests.begin(), t.side == 'l'};
  };
  std::ranges::stable_sort(tests, {}, rank);
  return tests;
}

}  // namespace

ReportTable examTable(const ExamFit& fit, const PhysicalExam& exam, const ClinicalTests& protocol) {
  ReportTable table;
  table.title = "Physical examination and the same tests on the model";
  table.columns = {"Test",
                   "Side",
                   "Measured, deg",
                   "Norm, deg",
                   "Model before, deg",
                   "Model after, deg",
                   "Residual, deg",
                   "Stop at, N\u00A0m",
                   "Limited by"};
  std::set<std::string> noted;
  std::vector<std::string> not_examined;
  for (const auto& comparison : inOrder(fit, protocol)) {
    const ClinicalTest& test = protocol.test(comparison.test);
    if (!entered(exam, comparison)) {
      if (not_examined.empty() || !not_examined.back().starts_with(test.title))
        not_examined.push_back(test.title + ", " + (comparison.side == 'l' ? "left" : "right"));
      else
        not_examined.back() = test.title;
      continue;
    }
    table.rows.push_back({test.title, sideText(comparison.side),
                          measuredText(comparison, exam) + judgement(comparison, test), normText(test, comparison),
                          numberText(comparison.simulated_before_deg), numberText(comparison.simulated_after_deg),
                          comparison.measured_deg ? signedText(comparison.residual_deg, 1) : kNotMeasured,
                          numberText(comparison.threshold_Nm), limitText(comparison)});
    if (!noted.insert(test.id).second) continue;
    table.sources.push_back(test.title + ": " + test.form->convention + "; norm " + normSource(test, comparison) +
                            "; measurement SD " + numberText(test.form->measurement_sd_deg) + " deg");
  }
  if (table.rows.empty()) table.rows.push_back({kNotMeasured, "", "", "", "", "", "", "", ""});
  table.footnote =
      "\u25B2 \u25BC more than 2 SD above or below the norm, beyond the measurement error. Residual = measured - "
      "model after; above " +
      numberText(kNamedResidual_deg) +
      " deg its reason stands in the annex. Stop at = passive moment at which the examiner is taken to stop, scaled "
      "with body mass. \u2021 norm not yet verified at its source. Conventions and sources: annex. Not measured: " +
      joined(not_examined, ", ", "none") + ".";
  return table;
}

ReportTable muscleTable(const ExamFit& fit, const ClinicalTests& protocol) {
  std::map<std::string, std::set<std::string>> limits;  // group + side -> tests
  for (const auto& comparison : fit.tests)
    for (const auto& muscle : comparison.limiting_muscles)
      for (const auto* group : groupsOf(protocol, muscle))
        limits[group->name + comparison.side].insert(protocol.test(comparison.test).title);
  const auto limited = [&](const LengthGroup& group) {
    std::set<std::string> tests = limits[group.name + 'r'];
    tests.merge(limits[group.name + 'l']);
    return joined({tests.begin(), tests.end()}, ", ", "none");
  };

  ReportTable table;
  table.title = "Muscle lengths found from the examination";
  table.columns = {
      "Muscle group", "Length factor right (95 %)", "Length factor left (95 %)", "Fibre only, R / L", "Force factor",
      "Limits"};
  for (const auto& group : protocol.groups)
    table.rows.push_back({group.title, factorText(fit, group, 'r'), factorText(fit, group, 'l'),
                          fiberText(fit, group), kNotMeasured, limited(group)});
  table.footnote =
      std::string{
          "Length factor: fibre and tendon length relative to what this skeleton calls for; below 1 short, "
          "above 1 long. Fibre only: factor of the fibre alone, tendon unchanged, that meets the same tests. "
          "undetermined: the tests narrow the factor to less than half of what is possible. not measured: no "
          "test of the group was examined, or no strength test entered. Limits: tests that the group carries "
          "at their end. "} +
      (fit.left_in_norm ? "Measurements inside the norm of the age, or within their SD of its mean, were left at 1; "
                          "beyond, lengths fade in."
                        : "Every measurement counts as it stands, inside the norm too.");
  return table;
}

ReportTable residualTable(const ExamFit& fit, const ClinicalTests& protocol) {
  ReportTable table;
  table.title = "Why the model does not meet a measurement";
  table.columns = {"Test", "Side", "Measured, deg", "Model after, deg", "Reason"};
  for (const auto& c : inOrder(fit, protocol))
    if (!c.reason.empty())
      table.rows.push_back({protocol.test(c.test).title, sideText(c.side), numberText(*c.measured_deg),
                            numberText(c.simulated_after_deg), c.reason});
  if (table.rows.empty()) table.rows.push_back({"none", "", "", "", ""});
  table.footnote = "Residuals above " + numberText(kNamedResidual_deg) + " deg.";
  return table;
}

ReportTable protocolTable(const ExamFit& fit, const ClinicalTests& protocol) {
  ReportTable table;
  table.title = "Protocol of the tests";
  table.columns = {"Test", "Convention", "What the examiner does", "SD, deg",
                   "Stop at " + numberText(protocol.reference_mass_kg) + "\u00A0kg, N\u00A0m"};
  std::set<std::string> shown;
  for (const auto& comparison : fit.tests) {
    const ClinicalTest& test = protocol.test(comparison.test);
    if (!shown.insert(test.id).second) continue;
    table.rows.push_back({test.title, test.form->convention, test.form->protocol,
                          numberText(test.form->measurement_sd_deg),
                          numberText(test.threshold_Nm) + "\u00A0\u00B1\u00A0" +
                              numberText(test.threshold_band_share * test.threshold_Nm)});
  }
  table.footnote =
      "SD: measurement noise of one examiner. The moment at the stop is a parameter of the method, not a "
      "measurement of this patient; its band (95 %) widens the intervals of the length factors.";
  return table;
}

ReportTable lengthFactorTable(const ExamFit& fit) {
  ReportTable table;
  table.title = "Length factor of every changed musculotendon unit";
  table.columns = {"Unit", "Right", "Left"};
  std::set<std::string> units;
  for (const auto& [unit, factor] : fit.length_factors) units.insert(std::string{withoutSide(unit)});
  const auto factorOfUnit = [&](const std::string& unit) {
    const auto it = fit.length_factors.find(unit);
    return it == fit.length_factors.end() ? std::string{"unchanged"} : numberText(it->second, 3);
  };
  for (const auto& unit : units)
    table.rows.push_back({readable(unit), factorOfUnit(unit + "_r"), factorOfUnit(unit + "_l")});
  if (table.rows.empty()) table.rows.push_back({"none changed", "unchanged", "unchanged"});
  table.footnote = "Fibre and tendon are scaled together.";
  return table;
}

std::vector<PassiveMomentPlot> passiveMomentPlots(const Case& c, const Model& before, const ClinicalTests& protocol) {
  std::vector<PassiveMomentPlot> plots;
  const Model after = withLengthFactors(before, c.exam_fit->length_factors);
  for (const auto& comparison : inOrder(*c.exam_fit, protocol)) {
    if (!entered(c.exam, comparison)) continue;
    const ClinicalTest& test = protocol.test(comparison.test);
    PassiveMomentPlot plot;
    plot.title = test.title + ", " + (comparison.side == 'l' ? "left" : "right");
    plot.convention = test.form->convention;
    plot.before = passiveMomentCurve(before, test, comparison.side);
    plot.after = passiveMomentCurve(after, test, comparison.side);
    plot.measured_deg = comparison.measured_deg.value_or(std::numeric_limits<double>::quiet_NaN());
    plot.simulated_after_deg = comparison.simulated_after_deg;
    plot.threshold_Nm = comparison.threshold_Nm;
    plot.norm_low_deg = comparison.norm_mean_deg - 2 * comparison.norm_sd_deg;
    plot.norm_high_deg = comparison.norm_mean_deg + 2 * comparison.norm_sd_deg;
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace sinew
