#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "core/model/audit_model.h"

namespace sinew {
namespace {

const char* nameOf(AuditVerdict verdict) {
  return verdict == AuditVerdict::Inside ? "inside" : verdict == AuditVerdict::Explained ? "explained" : "outlier";
}

Json findingJson(const AuditFinding& f) {
  return {{"unit", f.unit},
          {"quantity", f.quantity},
          {"value", numberOrNull(f.value)},
          {"low", numberOrNull(f.low)},
          {"high", numberOrNull(f.high)},
          {"verdict", nameOf(f.verdict)},
          {"verified", f.verified},
          {"source", f.source},
          {"reason", f.reason}};
}

Json unitJson(const AuditedUnit& u) {
  return {{"unit", u.name},
          {"max_isometric_force_N", numberOrNull(u.max_isometric_force_N)},
          {"published_force_N", numberOrNull(u.published_force_N)},
          {"source_tension_N_cm2", numberOrNull(u.source_tension_N_cm2)},
          {"pcsa_cm2", numberOrNull(u.pcsa_cm2)},
          {"body_scale", numberOrNull(u.body_scale)},
          {"optimal_fiber_length_m", numberOrNull(u.optimal_fiber_length_m)},
          {"published_fiber_length_m", numberOrNull(u.published_fiber_length_m)},
          {"tendon_slack_length_m", numberOrNull(u.tendon_slack_length_m)},
          {"published_tendon_length_m", numberOrNull(u.published_tendon_length_m)},
          {"tendon_to_fiber", numberOrNull(u.tendon_to_fiber)},
          {"pennation_deg", numberOrNull(u.pennation_rad * 180 / std::numbers::pi)},
          {"path_length_m", numberOrNull(u.path_length_m)},
          {"standing_fiber", numberOrNull(u.standing_fiber)}};
}

std::string rangeText(const AuditFinding& f) {
  return std::isfinite(f.low) ? fixed(f.low, 2) + " - " + fixed(f.high, 2) : "-";
}

/// Why a value is no outlier, or what it is beyond.
std::string reasonOf(const AuditFinding& f) {
  if (!f.reason.empty()) return f.reason;
  return "beyond " + f.source + (f.verified ? "" : " (from memory, not verified)");
}

/// Findings of one verdict, one table a reason.
std::string findingsText(const ModelAudit& audit, AuditVerdict verdict, const std::string& title) {
  std::vector<std::string> reasons;
  for (const AuditFinding& f : audit.findings)
    if (f.verdict == verdict && std::ranges::find(reasons, reasonOf(f)) == reasons.end())
      reasons.push_back(reasonOf(f));
  std::string text;
  for (const std::string& reason : reasons) {
    std::vector<std::vector<std::string>> rows;
    for (const AuditFinding& f : audit.findings)
      if (f.verdict == verdict && reasonOf(f) == reason)
        rows.push_back({f.unit, f.quantity, fixed(f.value, 2), rangeText(f)});
    text += title + ": " + reason + "\n" + textTable({"unit", "quantity", "value", "range"}, rows) + "\n";
  }
  return text;
}

std::string unitsText(const ModelAudit& audit) {
  std::vector<std::vector<std::string>> rows;
  for (const AuditedUnit& u : audit.units)
    rows.push_back({u.name, fixed(u.max_isometric_force_N, 0), fixed(u.pcsa_cm2, 1), fixed(u.source_tension_N_cm2, 0),
                    fixed(100 * u.optimal_fiber_length_m, 1), fixed(100 * u.published_fiber_length_m, 1),
                    fixed(100 * u.tendon_slack_length_m, 1), fixed(100 * u.published_tendon_length_m, 1),
                    fixed(u.tendon_to_fiber, 2), fixed(u.pennation_rad * 180 / std::numbers::pi, 0),
                    fixed(100 * u.path_length_m, 1), fixed(u.standing_fiber, 2), fixed(u.body_scale, 2)});
  return textTable({"unit", "F_max N", "PCSA cm2", "at N/cm2", "fibre cm", "publ.", "tendon cm", "publ.",
                    "tendon:fibre", "pennation", "path cm", "standing", "size"},
                   rows) +
         "\n";
}

Json auditJson(const std::string& model, const ModelAudit& audit, bool all) {
  Json findings = Json::array(), units = Json::array();
  for (const auto& f : audit.findings)
    if (all || f.verdict != AuditVerdict::Inside) findings.push_back(findingJson(f));
  for (const auto& u : audit.units) units.push_back(unitJson(u));
  return {{"format", "sinew.model_audit"},
          {"version", 1},
          {"model", model},
          {"judged", audit.findings.size()},
          {"inside", audit.count(AuditVerdict::Inside)},
          {"explained", audit.count(AuditVerdict::Explained)},
          {"outliers", audit.count(AuditVerdict::Outlier)},
          {"findings", findings},
          {"unjudged", audit.unjudged},
          {"units", units}};
}

std::string auditText(const std::string& model, const ModelAudit& audit, bool all) {
  std::string text = all ? unitsText(audit) : "";
  text += findingsText(audit, AuditVerdict::Explained, "Explained");
  text += findingsText(audit, AuditVerdict::Outlier, "Outlier");
  for (const auto& what : audit.unjudged) text += "not judged, because no range is known: " + what + "\n";
  return text + model + ": " + std::to_string(audit.findings.size()) + " figures judged, " +
         std::to_string(audit.count(AuditVerdict::Inside)) + " inside, " +
         std::to_string(audit.count(AuditVerdict::Explained)) + " explained, " +
         std::to_string(audit.count(AuditVerdict::Outlier)) + " outliers\n";
}

}  // namespace

void addAuditCommand(CLI::App& parent, Commands& commands) {
  struct Options {
    std::string model;
    bool all = false;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(
      parent, "audit", "muscle figures against ranges of the literature, at the body's size; 2 if any is unexplained",
      "sinew model audit reference --all");
  command.add_option("MODEL", o->model, "model file, or the word reference")->required();
  command.add_flag("--all", o->all, "the figures of every unit, not the outliers alone; with --json every verdict");
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      const Model model = session.model(o->model);
      const Model& reference = session.reference();
      const ModelAudit audit =
          auditModel(model, reference, loadAuditRanges(session.resourceDir(), reference.skeleton));
      session.result(auditJson(o->model, audit, o->all), auditText(o->model, audit, o->all));
      return audit.count(AuditVerdict::Outlier) == 0 ? ExitStatus::Done : ExitStatus::Unusable;
    };
  });
}

}  // namespace sinew
