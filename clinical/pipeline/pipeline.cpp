#include "clinical/pipeline/pipeline.h"

#include <chrono>
#include <cstdio>

#include "clinical/pipeline/stage_runs.h"

namespace sinew {
namespace {

/// A stage runs from inputs that are there, and on results that are today's.
void expectRunnable(const Case& c, Stage stage) {
  const std::string missing = missingInput(c, stage);
  if (!missing.empty()) throw InputError{{"stage " + nameOf(stage), "", "its input", missing}};
  for (const Stage earlier : kStages) {
    if (earlier == stage) return;
    const StageState state = stateOf(c, earlier);
    if (state != StageState::Done)
      throw InputError{{"stage " + nameOf(stage), nameOf(earlier), "done", nameOf(state)}};
  }
}

StageRun dispatch(Case& c, Stage stage, const PipelineContext& context, const Job& job) {
  switch (stage) {
    case Stage::Images:
      return runImages(c, context);
    case Stage::Calibration:
      return runCalibration(c, context, job);
    case Stage::Landmarks:
      return runLandmarks(c, context);
    case Stage::Skeleton:
      return runSkeleton(c, context, job);
    case Stage::Musculature:
      return runMusculature(c, context, job);
    case Stage::Exam:
      return runExam(c, context, job);
    case Stage::Report:
      return runReport(c, context);
  }
  return {.outcome = Outcome::NotRun, .warnings = {}, .summary = {}};
}

}  // namespace

std::string rounded(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

Case runStage(const Case& c, Stage stage, const PipelineContext& context, const Job& job) {
  require(context.reference != nullptr, "the pipeline has a reference model");
  expectRunnable(c, stage);
  const auto start = std::chrono::steady_clock::now();
  job.report(0, titleOf(stage));
  Case next = c;
  StageRun run = dispatch(next, stage, context, job);
  if (run.outcome != Outcome::Converged) next = c;  // earlier results stay, and are stale
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  next.stages[stage] = {run.outcome, inputHash(next, stage), seconds.count(), run.warnings, run.summary};
  job.report(1, titleOf(stage));
  return next;
}

}  // namespace sinew
