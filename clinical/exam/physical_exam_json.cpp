#include "clinical/exam/physical_exam_json.h"

#include "core/date_json.h"

namespace sinew {
namespace {

char sideFromJson(const JsonReader& json) {
  return json.oneOf({"r", "l"})[0];
}

std::optional<double> optionalNumber(const JsonReader& json, std::string_view member) {
  const auto found = json.find(member);
  return found ? std::optional{found->number()} : std::nullopt;
}

std::string optionalText(const JsonReader& json, std::string_view member) {
  const auto found = json.find(member);
  return found ? found->text() : std::string{};
}

ExamEntry entryFromJson(const JsonReader& json) {
  json.allowOnly({"test", "side", "measured_deg", "note", "threshold_Nm"});
  ExamEntry entry{.test = json["test"].text(),
                  .side = sideFromJson(json["side"]),
                  .measured_deg = optionalNumber(json, "measured_deg"),
                  .note = optionalText(json, "note"),
                  .threshold_Nm = {}};
  if (const auto threshold = json.find("threshold_Nm")) entry.threshold_Nm = threshold->positive();
  return entry;
}

Json comparisonToJson(const ExamComparison& c) {
  Json changed = Json::array();
  for (const auto& change : c.changed)
    changed.push_back({{"muscle", change.muscle}, {"length_factor", change.factor}});
  return {{"test", c.test},
          {"side", std::string(1, c.side)},
          {"measured_deg", numberOrNull(c.measured_deg)},
          {"simulated_before_deg", numberOrNull(c.simulated_before_deg)},
          {"simulated_after_deg", numberOrNull(c.simulated_after_deg)},
          {"residual_deg", numberOrNull(c.residual_deg)},
          {"threshold_Nm", c.threshold_Nm},
          {"stopped_by_joint", c.stopped_by_joint},
          {"limiting_muscles", c.limiting_muscles},
          {"changed", changed}};
}

ExamComparison comparisonFromJson(const JsonReader& json) {
  json.allowOnly({"test", "side", "measured_deg", "simulated_before_deg", "simulated_after_deg", "residual_deg",
                  "threshold_Nm", "stopped_by_joint", "limiting_muscles", "changed"});
  ExamComparison c;
  c.test = json["test"].text();
  c.side = sideFromJson(json["side"]);
  c.measured_deg = optionalNumber(json, "measured_deg");
  c.simulated_before_deg = json["simulated_before_deg"].numberOrNaN();
  c.simulated_after_deg = json["simulated_after_deg"].numberOrNaN();
  c.residual_deg = json["residual_deg"].numberOrNaN();
  c.threshold_Nm = json["threshold_Nm"].number();
  c.stopped_by_joint = json["stopped_by_joint"].boolean();
  for (const auto& muscle : json["limiting_muscles"].items()) c.limiting_muscles.push_back(muscle.text());
  for (const auto& change : json["changed"].items()) {
    change.allowOnly({"muscle", "length_factor"});
    c.changed.push_back({change["muscle"].text(), change["length_factor"].positive()});
  }
  return c;
}

}  // namespace

Json examToJson(const PhysicalExam& exam) {
  Json entries = Json::array();
  for (const auto& e : exam.entries) {
    Json entry{{"test", e.test}, {"side", std::string(1, e.side)}, {"measured_deg", numberOrNull(e.measured_deg)}};
    if (!e.note.empty()) entry["note"] = e.note;
    if (e.threshold_Nm) entry["threshold_Nm"] = *e.threshold_Nm;
    entries.push_back(entry);
  }
  return {{"format", "sinew.exam"},
          {"version", 1},
          {"examiner", exam.examiner},
          {"date", exam.date},
          {"entries", entries}};
}

PhysicalExam examFromJson(const JsonReader& json) {
  json.expectFormat("sinew.exam", 1);
  json.allowOnly({"format", "version", "examiner", "date", "entries"});
  PhysicalExam exam{.examiner = optionalText(json, "examiner"), .date = {}, .entries = {}};
  if (const auto date = json.find("date")) exam.date = dateFromJson(*date);
  for (const auto& entry : json["entries"].items()) exam.entries.push_back(entryFromJson(entry));
  return exam;
}

Json examFitToJson(const ExamFit& fit) {
  Json tests = Json::array();
  for (const auto& test : fit.tests) tests.push_back(comparisonToJson(test));
  return {{"outcome", nameOf(fit.outcome)},
          {"seconds", fit.seconds},
          {"warnings", warningsToJson(fit.warnings)},
          {"length_factors", factorsToJson(fit.length_factors)},
          {"tests", tests}};
}

ExamFit examFitFromJson(const JsonReader& json) {
  json.allowOnly({"outcome", "seconds", "warnings", "length_factors", "tests"});
  ExamFit fit;
  fit.outcome = outcomeFromJson(json["outcome"]);
  fit.seconds = json["seconds"].number();
  fit.warnings = warningsFromJson(json["warnings"]);
  fit.length_factors = factorsFromJson(json["length_factors"]);
  for (const auto& test : json["tests"].items()) fit.tests.push_back(comparisonFromJson(test));
  return fit;
}

Json factorsToJson(const std::map<std::string, double>& factors) {
  Json json = Json::object();
  for (const auto& [unit, factor] : factors) json[unit] = factor;
  return json;
}

std::map<std::string, double> factorsFromJson(const JsonReader& json) {
  std::map<std::string, double> factors;
  for (const auto& [unit, factor] : json.members()) factors[unit] = factor.positive();
  return factors;
}

}  // namespace sinew
