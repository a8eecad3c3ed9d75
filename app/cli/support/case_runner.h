#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/support/session.h"
#include "clinical/case/case.h"
#include "core/strict_json.h"

namespace sinew {

/// What `run` and `demo` are asked for.
struct RunRequest {
  std::optional<Stage> from;  ///< run this stage and everything after it even if fresh
  std::optional<Stage> to;    ///< last stage; without it as far as what was entered allows
};

/// What came of it, for the JSON contract of `run` and `demo`.
struct RunReport {
  ExitStatus status = ExitStatus::Done;
  std::vector<Stage> ran;
  Json stages = Json::array();        ///< one object a stage: name, outcome, seconds, warnings, ...
  std::optional<InputError> refused;  ///< a stage could not use its input
};

/// Files of the case that a person supplied: images, phantom images and its beads.
std::vector<FileReference> enteredFiles(const Case& c);

/// Runs the stages of a case that are not done, one line a stage on stdout, and saves the case after each, so that an
/// interrupted run loses nothing. Ends at the first stage that fails, is cancelled, or lacks its input: that is an
/// error only if the stage was asked for by `to`.
RunReport runCase(Case& c, const std::filesystem::path& folder, const RunRequest& request, Session& session);

/// Prints the result: the JSON contract of `run` and `demo` under `format`, or the files made and, for a synthetic
/// patient, the table truth / estimate / 95 % interval.
ExitStatus finishRun(const Case& c, const std::filesystem::path& folder, const RunReport& report,
                     const std::string& format, Session& session);

}  // namespace sinew
