#pragma once
#include <functional>
#include <span>
#include <vector>

#include "app/model/case_document.h"
#include "app/model/job_runner.h"

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

/// Copies the results of `stages`, in order, from `computed` into `c`, as long as each was computed from what `c`
/// says today; stops at the first whose inputs differ. Returns the stages that were taken over.
std::vector<Stage> mergeResults(Case& c, const Case& computed, std::span<const Stage> stages);

/// Stages that wait to be run, in order: everything from the first that is not done.
std::vector<Stage> stagesToRun(const CaseDocument& document);

/// Runs `stages` on a copy of the case beside the window. The results become one undo step, as far as their inputs
/// are still those of the case; a cancelled or failing run keeps the stages that had ended before.
/// @returns false if a computation is going on.
bool runStages(CaseDocument& document, JobRunner& runner, const StageServices& services, std::vector<Stage> stages);

}  // namespace sinew
