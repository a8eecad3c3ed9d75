#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "clinical/pipeline/pipeline.h"
#include "core/error.h"

namespace sinew {

/// Which stages a run takes.
struct RunRequest {
  std::optional<Stage> from;  ///< run this stage and everything after it even if done
  std::optional<Stage> to;    ///< last stage; without it as far as what was entered allows
};

/// What is told while a run goes on, on the thread that computes.
struct RunObserver {
  /// The stage was not run: it is done, or there is nothing to run it from.
  std::function<void(const Case&, const StageStatus&)> passed_over;
  /// The stage ran; its record is in the case. The place to save: an interrupted run then loses nothing. It may take
  /// into the case what others entered meanwhile, and refuse the result by InputError.
  std::function<void(Case&, Stage)> ended;
};

/// What came of a run.
struct CaseRun {
  Case c;
  std::vector<Stage> ran;
  Outcome outcome = Outcome::Converged;  ///< of the stage at which it ended
  std::optional<InputError> refused;     ///< that stage could not use its input
};

/// Files of the case that a person supplied: images, phantom images and its beads.
std::vector<FileReference> enteredFiles(const Case& c);

/// Runs the stages of a case that are not done, or whose files were lost, in order. Ends at the first that fails, is
/// cancelled or is refused. A stage whose input is missing is passed over, unless `to` asks for it or for one behind
/// it: then it is refused.
/// @throws InputError if a file that was entered is missing or changed: a finished stage says nothing about its files
/// any more, so they are looked at first.
CaseRun runCase(const Case& c, const RunRequest& request, const PipelineContext& context,
                const RunObserver& observer = {}, const Job& job = {});

/// Copies the results of `stages`, in order, from `computed` into `c`, as long as each was computed from what `c`
/// says today; stops at the first whose inputs differ. Returns the stages that were taken over.
std::vector<Stage> mergeResults(Case& c, const Case& computed, std::span<const Stage> stages,
                                const std::filesystem::path& resource_dir);

}  // namespace sinew
