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

/// Absent in files of before.
double optionalNaN(const JsonReader& json, std::string_view member) {
  const auto found = json.find(member);
  return found ? found->numberOrNaN() : std::numeric_limits<double>::quiet_NaN();
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
          {"reason", c.reason},
          {"norm_mean_deg", numberOrNull(c.norm_mean_deg)},
          {"norm_sd_deg", numberOrNull(c.norm_sd_deg)},
          {"threshold_Nm", c.threshold_Nm},
          {"stopped_by_joint", c.stopped_by_joint},
          {"limiting_muscles", c.limiting_muscles},
          {"limited_by", c.limited_by},
          {"changed", changed}};
}

ExamComparison comparisonFromJson(const JsonReader& json) {
  json.allowOnly({"test", "side", "measured_deg", "simulated_before_deg", "simulated_after_deg", "residual_deg",
                  "reason", "norm_mean_deg", "norm_sd_deg", "threshold_Nm", "stopped_by_joint", "limiting_muscles",
                  "limited_by", "changed"});
  ExamComparison c;
  c.test = json["test"].text();
  c.side = sideFromJson(json["side"]);
  c.measured_deg = optionalNumber(json, "measured_deg");
  c.simulated_before_deg = json["simulated_before_deg"].numberOrNaN();
  c.simulated_after_deg = json["simulated_after_deg"].numberOrNaN();
  c.residual_deg = json["residual_deg"].numberOrNaN();
  c.reason = optionalText(json, "reason");
  c.norm_mean_deg = optionalNaN(json, "norm_mean_deg");
  c.norm_sd_deg = optionalNaN(json, "norm_sd_deg");
  c.threshold_Nm = json["threshold_Nm"].number();
  c.stopped_by_joint = json["stopped_by_joint"].boolean();
  for (const auto& muscle : json["limiting_muscles"].items()) c.limiting_muscles.push_back(muscle.text());
  if (const auto limits = json.find("limited_by"))
    for (const auto& limit : limits->items()) c.limited_by.push_back(limit.text());
  for (const auto& change : json["changed"].items()) {
    change.allowOnly({"muscle", "length_factor"});
    c.changed.push_back({change["muscle"].text(), change["length_factor"].positive()});
  }
  return c;
}

GroupFactor groupFromJson(const JsonReader& json) {
  json.allowOnly(
      {"group", "side", "tested", "length_factor", "lower95", "upper95", "determined", "fiber_only_length_factor"});
  return {.group = json["group"].text(),
          .side = sideFromJson(json["side"]),
          .tested = json["tested"].boolean(),
          .factor = json["length_factor"].positive(),
          .lower95 = json["lower95"].numberOrNaN(),
          .upper95 = json["upper95"].numberOrNaN(),
          .determined = json["determined"].boolean(),
          .fiber_only_factor = json["fiber_only_length_factor"].positive()};
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
  Json json{{"format", "sinew.exam"}, {"version", 1}, {"examiner", exam.examiner}, {"date", exam.date}};
  if (!exam.leave_in_norm) json["leave_in_norm"] = false;
  json["entries"] = entries;
  return json;
}

PhysicalExam examFromJson(const JsonReader& json) {
  json.expectFormat("sinew.exam", 1);
  json.allowOnly({"format", "version", "examiner", "date", "leave_in_norm", "entries"});
  PhysicalExam exam{.examiner = optionalText(json, "examiner"), .date = {}, .entries = {}};
  if (const auto date = json.find("date")) exam.date = dateFromJson(*date);
  if (const auto leave = json.find("leave_in_norm")) exam.leave_in_norm = leave->boolean();
  for (const auto& entry : json["entries"].items()) exam.entries.push_back(entryFromJson(entry));
  return exam;
}

Json groupFactorToJson(const GroupFactor& g) {
  return {{"group", g.group},
          {"side", std::string(1, g.side)},
          {"tested", g.tested},
          {"length_factor", g.factor},
          {"lower95", numberOrNull(g.lower95)},
          {"upper95", numberOrNull(g.upper95)},
          {"determined", g.determined},
          {"fiber_only_length_factor", g.fiber_only_factor}};
}

Json examFitToJson(const ExamFit& fit) {
  Json groups = Json::array();
  for (const auto& group : fit.groups) groups.push_back(groupFactorToJson(group));
  Json tests = Json::array();
  for (const auto& test : fit.tests) tests.push_back(comparisonToJson(test));
  return {{"outcome", nameOf(fit.outcome)},
          {"seconds", fit.seconds},
          {"warnings", warningsToJson(fit.warnings)},
          {"left_in_norm", fit.left_in_norm},
          {"length_factors", factorsToJson(fit.length_factors)},
          {"groups", groups},
          {"tests", tests}};
}

ExamFit examFitFromJson(const JsonReader& json) {
  json.allowOnly({"outcome", "seconds", "warnings", "left_in_norm", "length_factors", "groups", "tests"});
  ExamFit fit;
  fit.outcome = outcomeFromJson(json["outcome"]);
  fit.seconds = json["seconds"].number();
  fit.warnings = warningsFromJson(json["warnings"]);
  fit.length_factors = factorsFromJson(json["length_factors"]);
  if (const auto left = json.find("left_in_norm")) fit.left_in_norm = left->boolean();
  if (const auto groups = json.find("groups"))
    for (const auto& group : groups->items()) fit.groups.push_back(groupFromJson(group));
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
