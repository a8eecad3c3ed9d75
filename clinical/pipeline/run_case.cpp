#include "clinical/pipeline/run_case.h"

#include <algorithm>

#include "clinical/case/case_io.h"
#include "clinical/pipeline/stage_table.h"

namespace sinew {
namespace {

/// The share of one stage in the progress of a run: named, and between `from` and `to` of the whole.
Job partOf(const Job& job, Stage stage, double from, double to) {
  Job part;
  part.stop = job.stop;
  part.report_to = [&job, title = titleOf(stage), from, to](double fraction, std::string_view what) {
    if (fraction >= 1) return;  // the end of a stage is no news: the next one or the result follows
    job.report(from + (to - from) * std::clamp(fraction, 0.0, 1.0),
               what.empty() || what == title ? title : title + ": " + std::string{what});
  };
  return part;
}

/// A stage whose files are not what the case says has lost its result, whatever its record says.
bool isIntact(const Case& c, Stage stage, const std::filesystem::path& case_dir) {
  const StageRow& row = rowOf(stage);
  if (!row.files) return true;
  return std::ranges::all_of(row.files(c), [&](const FileReference& file) { return isUndamaged(file, case_dir); });
}

bool isWanted(const Case& c, const StageStatus& status, const RunRequest& request,
              const std::filesystem::path& case_dir) {
  const bool forced = request.from && status.stage >= *request.from;
  if (status.state == StageState::Done) return forced || !isIntact(c, status.stage, case_dir);
  const bool runnable = status.state != StageState::Missing && status.state != StageState::Blocked;
  return runnable || request.to;
}

/// Number of stages that a run will take if all goes well: the scale of its progress.
std::size_t stagesAhead(const Case& c, const RunRequest& request, const PipelineContext& context) {
  std::size_t count = 0;
  for (const auto& status : statusOf(c, context.resource_dir))
    if (!request.to || status.stage <= *request.to)
      count += count > 0 || isWanted(c, status, request, context.case_dir);
  return std::max<std::size_t>(count, 1);
}

}  // namespace

std::vector<FileReference> enteredFiles(const Case& c) {
  std::vector<FileReference> files;
  for (const auto& image : c.images) files.push_back(image.file);
  if (c.phantom) {
    files.insert(files.end(), c.phantom->images.begin(), c.phantom->images.end());
    files.push_back(c.phantom->beads);
  }
  return files;
}

CaseRun runCase(const Case& c, const RunRequest& request, const PipelineContext& context, const RunObserver& observer,
                const Job& job) {
  for (const auto& file : enteredFiles(c)) checkedFile(file, context.case_dir);
  CaseRun run{.c = c, .ran = {}, .outcome = Outcome::Converged, .refused = {}};
  const double ahead = double(stagesAhead(c, request, context));
  for (const Stage stage : kStages) {
    if (request.to && stage > *request.to) break;
    const StageStatus status = statusOf(run.c, context.resource_dir).at(std::size_t(stage));
    if (!isWanted(run.c, status, request, context.case_dir)) {
      if (observer.passed_over) observer.passed_over(run.c, status);
      continue;
    }
    if (job.cancelled()) {
      run.outcome = Outcome::Cancelled;
      break;
    }
    try {
      const double done = double(run.ran.size());
      run.c = runStage(run.c, stage, context, partOf(job, stage, done / ahead, std::min(1.0, (done + 1) / ahead)));
      run.ran.push_back(stage);
      run.outcome = run.c.stages.at(stage).outcome;
      if (observer.ended) observer.ended(run.c, stage);
    } catch (const InputError& error) {
      run.refused = error;
      run.outcome = Outcome::NotRun;
      break;
    }
    if (run.outcome != Outcome::Converged) break;
  }
  return run;
}

std::vector<Stage> mergeResults(Case& c, const Case& computed, std::span<const Stage> stages,
                                const std::filesystem::path& resource_dir) {
  std::vector<Stage> taken;
  for (const Stage stage : stages) {
    const auto record = computed.stages.find(stage);
    if (record == computed.stages.end() || record->second.input_hash != inputHash(c, stage, resource_dir)) break;
    rowOf(stage).copy_result(c, computed);
    c.stages[stage] = record->second;
    taken.push_back(stage);
  }
  return taken;
}

}  // namespace sinew
