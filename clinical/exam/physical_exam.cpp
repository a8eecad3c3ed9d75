#include "clinical/exam/physical_exam.h"

#include <cmath>
#include <cstdio>
#include <set>

#include "clinical/exam/exam_problem_internal.h"
#include "clinical/exam/physical_exam_json.h"
#include "core/file.h"
#include "core/strict_json.h"

namespace sinew {
namespace {

std::string degrees(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g deg", value);
  return text;
}

/// Pairs of one side that no body has.
void checkContradictions(const PhysicalExam& exam, const ClinicalTests& tests, Warnings& warnings) {
  for (const char side : {'r', 'l'})
    for (const TestContradiction* rule : contradictionsOf(exam, tests, side))
      warnings.push_back({"exam_contradiction", std::string{side == 'r' ? "right" : "left"} + ": " + rule->text +
                                                    " (" + tests.test(rule->first).title + " against " +
                                                    tests.test(rule->second).title + ")"});
}

}  // namespace

Warnings checkExam(const PhysicalExam& exam, const ClinicalTests& tests) {
  Warnings warnings;
  std::set<std::pair<std::string, char>> seen;
  for (const auto& entry : exam.entries) {
    const ClinicalTest& test = tests.test(entry.test);
    if (!test.form) throw InputError{{"exam: " + test.title, "test", "one of the form of the examination", test.id}};
    const FormRow& form = *test.form;
    const std::string where = "exam: " + test.title + (entry.side == 'r' ? " (right)" : " (left)");
    if (entry.side != 'r' && entry.side != 'l')
      throw InputError{{"exam: " + test.title, "side", "r or l", std::string(1, entry.side)}};
    if (!seen.insert({test.id, entry.side}).second)
      throw InputError{{where, "entry", "one line a test and side", "two"}};
    if (entry.threshold_Nm && !(*entry.threshold_Nm > 0))
      throw InputError{{where, "threshold_Nm", "a number > 0", std::to_string(*entry.threshold_Nm)}};
    if (!entry.measured_deg) continue;
    const double x = *entry.measured_deg;
    if (!(x >= form.entry_min_deg && x <= form.entry_max_deg))
      throw InputError{
          {where, "measured_deg", degrees(form.entry_min_deg) + " to " + degrees(form.entry_max_deg), degrees(x)}};
    if (x < form.doubt_min_deg || x > form.doubt_max_deg)
      warnings.push_back({"exam_unusual", where.substr(6) + ": " + degrees(x) + " is outside the usual " +
                                              degrees(form.doubt_min_deg) + " to " + degrees(form.doubt_max_deg)});
  }
  checkContradictions(exam, tests, warnings);
  return warnings;
}

PhysicalExam loadExam(const std::filesystem::path& file) {
  const Json document = parseJson(readFile(file, std::uintmax_t{16} << 20), file.string());
  return examFromJson({document, file.string()});
}

void saveExam(const PhysicalExam& exam, const std::filesystem::path& file) {
  writeFileAtomically(file, jsonText(examToJson(exam)));
}

Model withLengthFactors(const Model& model, const std::map<std::string, double>& factors) {
  Model changed = model;
  for (const auto& [name, factor] : factors) {
    MusculotendonUnit& unit = changed.musculature.units[changed.musculature.unitIndex(name)];
    unit.optimal_fiber_length_m *= factor;
    unit.tendon_slack_length_m *= factor;
    changed.length_factors[name] =
        factor * (model.length_factors.contains(name) ? model.length_factors.at(name) : 1.0);
  }
  return changed;
}

}  // namespace sinew
