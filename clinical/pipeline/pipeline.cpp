#include "clinical/pipeline/pipeline.h"

#include <chrono>

#include "clinical/pipeline/stage_table.h"

namespace sinew {
namespace {

/// A stage runs from inputs that are there, and on results that are today's.
void expectRunnable(const Case& c, Stage stage, const std::filesystem::path& resource_dir) {
  const auto all = statusOf(c, resource_dir);
  const std::string& missing = all.at(std::size_t(stage)).missing;
  if (!missing.empty()) throw InputError{{"stage " + nameOf(stage), "", "its input", missing}};
  for (const auto& earlier : all) {
    if (earlier.stage == stage) return;
    if (earlier.state != StageState::Done)
      throw InputError{{"stage " + nameOf(stage), nameOf(earlier.stage), "done", nameOf(earlier.state)}};
  }
}

}  // namespace

Case runStage(const Case& c, Stage stage, const PipelineContext& context, const Job& job) {
  require(context.reference != nullptr, "the pipeline has a reference model");
  expectRunnable(c, stage, context.resource_dir);
  const auto start = std::chrono::steady_clock::now();
  job.report(0, titleOf(stage));
  Case next = c;
  const std::string read = inputHash(c, stage, context.resource_dir);  // before: what changes meanwhile was not read
  StageRun run = rowOf(stage).run(next, context, job);
  if (run.outcome != Outcome::Converged) next = c;  // earlier results stay, and are stale
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  next.stages[stage] = {run.outcome, read, seconds.count(), run.warnings, run.summary};
  job.report(1, titleOf(stage));
  return next;
}

}  // namespace sinew
