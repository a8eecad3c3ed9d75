#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "clinical/report/judgement.h"
#include "clinical/report/report_tables.h"

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

std::string measuredText(const ExamComparison& comparison, const PhysicalExam& exam) {
  if (comparison.measured_deg) return numberText(*comparison.measured_deg);
  const auto* entry = entryOf(exam, comparison);
  return entry && !entry->note.empty() ? std::string{kNotMeasured} + ": " + entry->note : kNotMeasured;
}

/// Marked like a bone: beyond 2 SD of the norm, and beyond the measurement error of one examiner.
std::string judgement(const ExamComparison& comparison, const ExamTest& test) {
  if (!comparison.measured_deg) return {};
  return markOf(
      judgeMeasured(*comparison.measured_deg, test.measurement_sd_deg, test.norm_mean_deg, test.norm_sd_deg));
}

std::string normText(const ExamTest& test) {
  if (!std::isfinite(test.norm_mean_deg)) return kNoNorm;
  return numberText(test.norm_mean_deg) +
         (std::isfinite(test.norm_sd_deg) ? "\u00A0\u00B1\u00A0" + numberText(test.norm_sd_deg) : "") +
         (test.norm_verified ? "" : "\u00A0\u2021");
}

/// Muscles that carry the moment where the test ends, or what else stops it.
std::string limitText(const ExamComparison& comparison) {
  if (comparison.stopped_by_joint) return "joint (bone, capsule)";
  std::vector<std::string> names;
  for (const auto& muscle : comparison.limiting_muscles) names.push_back(readable(muscle));
  return joined(names, ", ", "nothing within the sweep");
}

std::vector<const LengthGroup*> groupsOf(const ExamProtocol& protocol, std::string_view unit) {
  std::vector<const LengthGroup*> groups;
  for (const auto& group : protocol.groups)
    if (std::ranges::find(group.units, withoutSide(unit)) != group.units.end()) groups.push_back(&group);
  return groups;
}

struct FactorRange {
  double low = 1, high = 1;
  bool any = false;
};
FactorRange factorsOf(const ExamFit& fit, const LengthGroup& group, char side) {
  FactorRange range;
  for (const auto& unit : group.units) {
    const auto it = fit.length_factors.find(unit + "_" + side);
    const double factor = it == fit.length_factors.end() ? 1 : it->second;
    range.low = range.any ? std::min(range.low, factor) : factor;
    range.high = range.any ? std::max(range.high, factor) : factor;
    range.any = true;
  }
  return range;
}

/// Whether an examined test of that side speaks about the group.
bool examined(const ExamFit& fit, const ExamProtocol& protocol, const LengthGroup& group, char side) {
  return std::ranges::any_of(fit.tests, [&](const ExamComparison& t) {
    const auto& groups = protocol.test(t.test).muscle_groups;
    return t.side == side && t.measured_deg && std::ranges::find(groups, group.name) != groups.end();
  });
}

std::string factorText(const ExamFit& fit, const ExamProtocol& protocol, const LengthGroup& group, char side) {
  if (!examined(fit, protocol, group, side)) return kNotMeasured;
  const auto range = factorsOf(fit, group, side);
  const std::string low = numberText(range.low, 2), high = numberText(range.high, 2);
  return low == high ? low : low + " to " + high;
}

/// In the protocol's order, right before left.
std::vector<ExamComparison> inOrder(const ExamFit& fit, const ExamProtocol& protocol) {
  auto tests = fit.tests;
  const auto rank = [&](const ExamComparison& t) {
    const auto it = std::ranges::find(protocol.tests, t.test, &ExamTest::id);
    return std::pair{it - protocol.tests.begin(), t.side == 'l'};
  };
  std::ranges::stable_sort(tests, {}, rank);
  return tests;
}

}  // namespace

ReportTable examTable(const ExamFit& fit, const PhysicalExam& exam, const ExamProtocol& protocol) {
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
  for (const auto& comparison : inOrder(fit, protocol)) {
    const ExamTest& test = protocol.test(comparison.test);
    table.rows.push_back({test.title, sideText(comparison.side),
                          measuredText(comparison, exam) + judgement(comparison, test), normText(test),
                          numberText(comparison.simulated_before_deg), numberText(comparison.simulated_after_deg),
                          comparison.measured_deg ? signedText(comparison.residual_deg, 1) : kNotMeasured,
                          numberText(comparison.threshold_Nm), limitText(comparison)});
    if (!noted.insert(test.id).second) continue;
    std::string note = test.title + ": " + test.convention;
    if (!test.norm_source.empty()) note += "; norm " + test.norm_source;
    note += "; measurement SD " + numberText(test.measurement_sd_deg) + " deg";
    table.sources.push_back(note);
  }
  table.footnote =
      "\u25B2 \u25BC more than 2 SD above or below the norm, beyond the measurement error. Residual = measured - "
      "model "
      "after. Stop at = passive moment at which the examiner is taken to stop, scaled "
      "with "
      "body mass. \u2021 norm not yet verified at its source. Conventions and sources: annex.";
  return table;
}

ReportTable muscleTable(const ExamFit& fit, const ExamProtocol& protocol) {
  std::map<std::string, std::set<std::string>> limits;  // group + side -> tests
  for (const auto& comparison : fit.tests)
    for (const auto& muscle : comparison.limiting_muscles)
      for (const auto* group : groupsOf(protocol, muscle))
        limits[group->name + comparison.side].insert(protocol.test(comparison.test).title);
  const auto limited = [&](const LengthGroup& group, char side) {
    const auto& tests = limits[group.name + side];
    return joined({tests.begin(), tests.end()}, ", ", "none");
  };

  ReportTable table;
  table.title = "Muscle lengths found from the examination";
  table.columns = {"Muscle group", "Length factor right", "Length factor left",
                   "Force factor", "Limits, right side",  "Limits, left side"};
  for (const auto& group : protocol.groups)
    table.rows.push_back({group.title, factorText(fit, protocol, group, 'r'), factorText(fit, protocol, group, 'l'),
                          kNotMeasured, limited(group, 'r'), limited(group, 'l')});
  table.footnote =
      "Length factor: fibre and tendon length relative to what this skeleton calls for; below 1 short, above 1 long. "
      "not "
      "measured: no test of the group was examined, or no strength test entered. Limits: the group carries most of "
      "the "
      "passive moment where the test ends.";
  return table;
}

ReportTable protocolTable(const ExamFit& fit, const ExamProtocol& protocol) {
  ReportTable table;
  table.title = "Protocol of the tests";
  table.columns = {"Test", "Convention", "What the examiner does", "SD, deg", "Stop at 75\u00A0kg, N\u00A0m"};
  std::set<std::string> shown;
  for (const auto& comparison : fit.tests) {
    const ExamTest& test = protocol.test(comparison.test);
    if (!shown.insert(test.id).second) continue;
    table.rows.push_back({test.title, test.convention, test.protocol, numberText(test.measurement_sd_deg),
                          numberText(test.threshold_Nm)});
  }
  table.footnote =
      "SD: measurement noise of one examiner. The moment at the stop is a parameter of the method, not a "
      "measurement of this patient.";
  return table;
}

ReportTable lengthFactorTable(const ExamFit& fit) {
  ReportTable table;
  table.title = "Length factor of every changed musculotendon unit";
  table.columns = {"Unit", "Right", "Left"};
  std::set<std::string> units;
  for (const auto& [unit, factor] : fit.length_factors) units.insert(std::string{withoutSide(unit)});
  const auto factorOf = [&](const std::string& unit) {
    const auto it = fit.length_factors.find(unit);
    return it == fit.length_factors.end() ? std::string{"unchanged"} : numberText(it->second, 3);
  };
  for (const auto& unit : units) table.rows.push_back({readable(unit), factorOf(unit + "_r"), factorOf(unit + "_l")});
  if (table.rows.empty()) table.rows.push_back({"none changed", "unchanged", "unchanged"});
  table.footnote = "Fibre and tendon are scaled together.";
  return table;
}

std::vector<PassiveMomentPlot> passiveMomentPlots(const Case& c, const Model& before, const ExamProtocol& protocol) {
  std::vector<PassiveMomentPlot> plots;
  const Model after = withLengthFactors(before, c.exam_fit->length_factors);
  for (const auto& comparison : inOrder(*c.exam_fit, protocol)) {
    const ExamTest& test = protocol.test(comparison.test);
    PassiveMomentPlot plot;
    plot.title = test.title + ", " + (comparison.side == 'l' ? "left" : "right");
    plot.convention = test.convention;
    plot.before = passiveMomentCurve(before, test, comparison.side);
    plot.after = passiveMomentCurve(after, test, comparison.side);
    plot.measured_deg = comparison.measured_deg.value_or(std::numeric_limits<double>::quiet_NaN());
    plot.simulated_after_deg = comparison.simulated_after_deg;
    plot.threshold_Nm = comparison.threshold_Nm;
    plot.norm_low_deg = test.norm_mean_deg - 2 * test.norm_sd_deg;
    plot.norm_high_deg = test.norm_mean_deg + 2 * test.norm_sd_deg;
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace sinew
