#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/support/session.h"
#include "clinical/case/case.h"
#include "clinical/pipeline/run_case.h"
#include "core/strict_json.h"

namespace sinew {

/// What came of it, for the JSON contract of `run` and `demo`.
struct RunReport {
  ExitStatus status = ExitStatus::Done;
  std::vector<Stage> ran;
  Json stages = Json::array();        ///< one object a stage: name, outcome, seconds, warnings, ...
  std::optional<InputError> refused;  ///< a stage could not use its input
};

/// runCase() on the case that `folder` holds, with one line a stage on stdout; the result of each is stored, so that
/// an interrupted run loses nothing. `c` is the case afterwards.
RunReport runAndStore(Case& c, const std::filesystem::path& folder, const RunRequest& request, Session& session);

/// Prints the result: the JSON contract of `run` and `demo` under `format`, or the files made and, for a synthetic
/// patient, the table truth / estimate / 95 % interval.
ExitStatus finishRun(const Case& c, const std::filesystem::path& folder, const RunReport& report,
                     const std::string& format, Session& session);

}  // namespace sinew
