#include <algorithm>
#include <map>

#include "clinical/pipeline/resource_hash.h"
#include "clinical/pipeline/stage_inputs_json.h"
#include "clinical/pipeline/stage_table.h"
#include "core/file.h"

namespace sinew {
namespace {

/// State of a stage whose inputs are there, behind one that is done.
StageState stateFromRecord(const Case& c, const StageRow& row, const std::filesystem::path& resource_dir) {
  const auto it = c.stages.find(row.stage);
  const bool ran = it != c.stages.end() && it->second.outcome != Outcome::NotRun;
  const bool fresh = ran && it->second.input_hash == inputHash(c, row.stage, resource_dir);
  if (fresh && it->second.outcome == Outcome::Converged && row.has_result(c)) return StageState::Done;
  if (fresh && it->second.outcome == Outcome::NotConverged) return StageState::Failed;
  return row.has_result(c) ? StageState::Stale : StageState::Ready;
}

}  // namespace

std::string nameOf(StageState state) {
  switch (state) {
    case StageState::Missing:
      return "missing";
    case StageState::Blocked:
      return "blocked";
    case StageState::Ready:
      return "ready";
    case StageState::Stale:
      return "stale";
    case StageState::Done:
      return "done";
    case StageState::Failed:
      return "failed";
  }
  return "";
}

std::string inputHash(const Case& c, Stage stage, const std::filesystem::path& resource_dir) {
  const StageRow& row = rowOf(stage);
  Json resources = Json::object();
  for (const char* path : row.resources) resources[path] = resourceHash(resource_dir, path);
  return sha256(inputText(
      {{"stage", row.name}, {"revision", row.revision}, {"resources", resources}, {"inputs", row.inputs(c)}}));
}

std::vector<StageStatus> statusOf(const Case& c, const std::filesystem::path& resource_dir) {
  std::vector<StageStatus> all;
  StageState before = StageState::Done;
  for (const Stage stage : kStages) {
    const StageRow& row = rowOf(stage);
    StageStatus status{stage, StageState::Missing, row.missing ? row.missing(c, before) : ""};
    if (status.missing.empty()) {
      if (before != StageState::Done)
        status.state = row.has_result(c) ? StageState::Stale : StageState::Blocked;
      else
        status.state = stateFromRecord(c, row, resource_dir);
    }
    before = status.state;
    all.push_back(std::move(status));
  }
  return all;
}

StageState stateOf(const Case& c, Stage stage, const std::filesystem::path& resource_dir) {
  return statusOf(c, resource_dir).at(std::size_t(stage)).state;
}

std::string missingInput(const Case& c, Stage stage, const std::filesystem::path& resource_dir) {
  return statusOf(c, resource_dir).at(std::size_t(stage)).missing;
}

bool resultIsOfToday(const Case& c, Stage stage, const std::filesystem::path& resource_dir) {
  return stateFromRecord(c, rowOf(stage), resource_dir) == StageState::Done;
}

std::vector<ResourceUse> resourcesRead(const std::filesystem::path& resource_dir) {
  std::map<std::string, ResourceUse> by_path;
  for (const Stage stage : kStages)
    for (const char* path : rowOf(stage).resources) {
      ResourceUse& use = by_path[path];
      if (use.path.empty()) use = {path, resourceHash(resource_dir, path), {}};
      use.read_by.push_back(stage);
    }
  std::vector<ResourceUse> all;
  for (auto& [path, use] : by_path) all.push_back(std::move(use));
  return all;
}

std::vector<std::string> reasonsAgainstReport(const Case& c, const std::filesystem::path& resource_dir) {
  std::vector<std::string> reasons;
  for (const auto& [stage, state, missing] : statusOf(c, resource_dir)) {
    if (stage == Stage::Report) break;
    if (state == StageState::Done) continue;
    reasons.push_back(titleOf(stage) + ": " + nameOf(state) + (missing.empty() ? "" : " - " + missing));
  }
  return reasons;
}

}  // namespace sinew
