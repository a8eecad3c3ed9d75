#pragma once
#include <functional>

#include "app/model/case_document.h"
#include "app/model/job_runner.h"
#include "clinical/pipeline/run_case.h"

namespace sinew {

class RetargetReference;

/// What the window supplies for running stages. `reference` and `retargeting` are called on the worker thread and may
/// read files.
struct StageServices {
  std::filesystem::path resource_dir;
  std::function<std::shared_ptr<const Model>()> reference;
  std::function<std::shared_ptr<const RetargetReference>()> retargeting;  ///< as `reference`
  std::function<void(const Case&, const std::filesystem::path& case_dir, const std::filesystem::path& pdf)>
      write_report;
};

/// Whether a stage waits to be run.
bool hasStagesToRun(const CaseDocument& document);

/// Runs a copy of the case beside the window (runCase()). The results become one undo step, as far as their inputs
/// are still those of the case; a cancelled or failing run keeps the stages that had ended before.
/// @returns false if a computation is going on.
bool runStages(CaseDocument& document, JobRunner& runner, const StageServices& services, const RunRequest& request);

}  // namespace sinew
