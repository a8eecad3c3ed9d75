#include "app/cli/support/case_runner.h"

#include <spdlog/spdlog.h>

#include "app/cli/support/text_table.h"
#include "clinical/case/case_io.h"
#include "clinical/pipeline/case_store.h"
#include "clinical/pipeline/pipeline.h"
#include "clinical/synthetic/synthetic_case.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

PipelineContext contextFor(Session& session, const std::filesystem::path& folder) {
  PipelineContext context;
  context.resource_dir = session.resourceDir();
  context.case_dir = folder;
  context.reference = &session.reference();
  context.retargeting = [&session] { return session.retargeting(); };
  if (session.reportWriter())
    context.write_report = [&session](const Case& c, const std::filesystem::path& case_dir,
                                      const std::filesystem::path& pdf) {
      session.reportWriter()(c, case_dir, pdf, session.reference(), session.resourceDir());
    };
  return context;
}

/// "landmarks    converged    0.12 s  52 points in both views, RMS 1.30 px"
std::string stageLine(Stage stage, const std::string& outcome, const std::string& seconds, const std::string& text) {
  char line[64];
  std::snprintf(line, sizeof line, "%-12s %-13s %9s  ", nameOf(stage).c_str(), outcome.c_str(), seconds.c_str());
  std::string whole = line + text;
  return whole.substr(0, whole.find_last_not_of(' ') + 1);
}

Json stageJson(Stage stage, const std::string& outcome, const StageRecord* record) {
  return {{"name", nameOf(stage)},
          {"outcome", outcome},
          {"seconds", record ? Json(record->seconds) : Json(nullptr)},
          {"warnings", record ? warningsToJson(record->warnings) : Json::array()},
          {"summary", record ? record->summary : ""}};
}

/// A stage that was not run, and why: done already, or nothing to run it from.
void passOver(RunReport& report, const Case& c, const StageStatus& status, Session& session) {
  const auto it = c.stages.find(status.stage);
  const StageRecord* record = status.state == StageState::Done ? &it->second : nullptr;
  session.resultLine(stageLine(status.stage, nameOf(status.state), record ? "up to date" : "",
                               record ? record->summary : status.missing));
  Json json = stageJson(status.stage, nameOf(status.state), record);
  json["missing"] = status.missing;
  report.stages.push_back(json);
}

void tell(RunReport& report, const Case& c, Stage stage, Session& session) {
  const StageRecord& record = c.stages.at(stage);
  report.stages.push_back(stageJson(stage, std::string{nameOf(record.outcome)}, &record));
  session.resultLine(
      stageLine(stage, std::string{nameOf(record.outcome)}, fixed(record.seconds, 2) + " s", record.summary));
  session.warn(record.warnings);
}

}  // namespace

RunReport runAndStore(Case& c, const std::filesystem::path& folder, const RunRequest& request, Session& session) {
  RunReport report;
  RunObserver observer;
  observer.passed_over = [&](const Case& now, const StageStatus& status) { passOver(report, now, status, session); };
  CaseStore store{folder, session.resourceDir()};
  c = store.load();
  observer.ended = [&](Case& now, Stage stage) {
    spdlog::debug("stage {}", nameOf(stage));
    store.store(now, stage);
    tell(report, now, stage, session);
  };
  CaseRun run = runCase(c, request, contextFor(session, folder), observer, session.job());
  c = std::move(run.c);
  report.ran = std::move(run.ran);
  report.refused = std::move(run.refused);
  report.status = report.refused ? ExitStatus::Unusable : statusOf(run.outcome);
  return report;
}

namespace {

/// {"stages", "files", "truth_comparison"} of the contract, with format and version.
Json runJson(const Case& c, const std::filesystem::path& folder, const RunReport& report, const std::string& format,
             Session& session) {
  const auto path = [&](const std::optional<FileReference>& file, Stage stage) {
    // Never name what is stale or lost.
    const bool fresh =
        file && stateOf(c, stage, session.resourceDir()) == StageState::Done && isUndamaged(*file, folder);
    return fresh ? Json((folder / file->path).string()) : Json(nullptr);
  };
  Json json{{"format", format},
            {"version", 1},
            {"stages", report.stages},
            {"files",
             {{"case", (folder / "case.json").string()},
              {"report", path(c.report, Stage::Report)},
              {"model", path(c.model, Stage::Musculature)}}}};
  if (!c.truth || !c.skeleton) return json;
  json["truth_comparison"] = Json::array();
  for (const auto& t : compareWithTruth(c))
    json["truth_comparison"].push_back({{"quantity", t.quantity},
                                        {"side", t.side},
                                        {"unit", t.unit},
                                        {"truth", numberOrNull(t.truth)},
                                        {"estimate", numberOrNull(t.estimate)},
                                        {"lower95", numberOrNull(t.lower95)},
                                        {"upper95", numberOrNull(t.upper95)}});
  return json;
}

/// Truth, estimate and interval of every figure of a synthetic patient.
std::string truthTable(const Case& c) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& t : compareWithTruth(c))
    rows.push_back({t.quantity, t.side, t.unit, fixed(t.truth, 1), fixed(t.estimate, 1),
                    fixed(t.lower95, 1) + " ... " + fixed(t.upper95, 1)});
  return textTable({"quantity", "side", "unit", "truth", "estimate", "95 % interval"}, rows);
}

}  // namespace

ExitStatus finishRun(const Case& c, const std::filesystem::path& folder, const RunReport& report,
                     const std::string& format, Session& session) {
  const Json json = runJson(c, folder, report, format, session);
  if (report.refused) {
    session.failure(report.refused->detail(), report.refused->what(), json);
    return report.status;
  }
  std::string text;
  if (c.truth && stateOf(c, Stage::Skeleton, session.resourceDir()) == StageState::Done)
    text += "\n" + truthTable(c) + "\n";
  for (const auto& [name, path] : json["files"].items())
    if (path.is_string())
      text += name + std::string(name.size() < 8 ? 8 - name.size() : 1, ' ') + path.get<std::string>() + "\n";
  session.result(json, text);
  return report.status;
}

}  // namespace sinew
