#include <cstdio>
#include <memory>

#include "app/cli/support/case_runner.h"
#include "app/cli/support/commands.h"
#include "clinical/case/case_io.h"
#include "clinical/pipeline/pipeline.h"

namespace sinew {
namespace {

/// Every file that the case refers to.
std::vector<FileReference> filesOf(const Case& c) {
  std::vector<FileReference> files = enteredFiles(c);
  if (c.musculature) files.push_back(*c.musculature);
  if (c.model) files.push_back(*c.model);
  if (c.report) files.push_back(*c.report);
  return files;
}

/// What is wrong with a file; empty if it is what the case says.
std::string damage(const FileReference& file, const std::filesystem::path& folder) {
  try {
    checkedFile(file, folder);
    return {};
  } catch (const InputError& error) {
    return error.detail().found;
  }
}

const StageRecord* recordOf(const Case& c, Stage stage) {
  const auto it = c.stages.find(stage);
  return it == c.stages.end() ? nullptr : &it->second;
}

Json stageJson(const StageStatus& status, const StageRecord* record) {
  return {{"name", nameOf(status.stage)},
          {"state", nameOf(status.state)},
          {"missing", status.missing},
          {"outcome", nameOf(record ? record->outcome : Outcome::NotRun)},
          {"seconds", record ? Json(record->seconds) : Json(nullptr)},
          {"summary", record ? record->summary : ""},
          {"warnings", record ? warningsToJson(record->warnings) : Json::array()}};
}

ExitStatus showStatus(const std::filesystem::path& folder, Session& session) {
  const Case c = loadCase(folder);
  Json stages = Json::array(), files = Json::array(), resources = Json::array();
  std::string lines;
  std::string notes;
  for (const auto& status : statusOf(c, session.resourceDir())) {
    const StageRecord* record = recordOf(c, status.stage);
    stages.push_back(stageJson(status, record));
    const std::string name = nameOf(status.stage);
    char line[64];
    std::snprintf(line, sizeof line, "%-12s %-9s ", name.c_str(), nameOf(status.state).c_str());
    lines += line + (status.missing.empty() && record ? record->summary : status.missing) + "\n";
    if (record)
      for (const auto& w : record->warnings) notes += "warning: " + name + ": " + w.message + "\n";
  }
  for (const auto& use : resourcesRead(session.resourceDir())) {
    Json readers = Json::array();
    for (const Stage stage : use.read_by) readers.push_back(nameOf(stage));
    resources.push_back({{"path", use.path}, {"sha256", use.sha256}, {"read_by", readers}});
    notes += "reference data: " + use.path + " " + use.sha256.substr(0, 16) + "\n";
  }
  for (const auto& file : filesOf(c)) {
    const std::string found = damage(file, folder);
    files.push_back({{"path", file.path}, {"sha256", file.sha256}, {"intact", found.empty()}, {"found", found}});
    if (!found.empty()) notes += "damaged: " + file.path + ": " + found + "\n";
  }
  session.result(
      {{"format", "sinew.status"}, {"version", 1}, {"stages", stages}, {"files", files}, {"resources", resources}},
      lines + notes);
  return ExitStatus::Done;
}

}  // namespace

void addStatusCommand(Commands& commands) {
  auto folder = std::make_shared<std::filesystem::path>();
  auto& command = addCommand(commands.app, "status", "what a case holds, what is stale, every warning",
                             "sinew status mycase --json");
  command.add_option("CASE", *folder, "case folder")->required();
  command.callback([&commands, folder] {
    commands.chosen = [&session = commands.session, folder] { return showStatus(*folder, session); };
  });
}

}  // namespace sinew
