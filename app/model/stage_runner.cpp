#include "app/model/stage_runner.h"

#include <algorithm>
#include <mutex>

namespace sinew {
namespace {

/// Stages that ended, readable from the GUI thread while the next one is computed.
struct Progress {
  std::mutex mutex;
  Case computed;
  std::vector<Stage> ended;
  std::optional<std::string> error;
};

void copyResult(Case& c, const Case& from, Stage stage) {
  switch (stage) {
    case Stage::Images:
      c.images = from.images;
      break;
    case Stage::Calibration:
      c.rig = from.rig;
      break;
    case Stage::Landmarks:
      c.landmarks = from.landmarks;
      break;
    case Stage::Skeleton:
      c.skeleton = from.skeleton;
      break;
    case Stage::Musculature:
      c.musculature = from.musculature;
      c.model = from.model;
      break;
    case Stage::Exam:
      c.exam_fit = from.exam_fit;
      c.model = from.model;
      break;
    case Stage::Report:
      c.report = from.report;
      break;
  }
  if (const auto record = from.stages.find(stage); record != from.stages.end()) c.stages[stage] = record->second;
}

QString labelOf(const std::vector<Stage>& stages) {
  if (stages.size() == 1) return QObject::tr("Run %1").arg(QString::fromStdString(titleOf(stages.front())).toLower());
  return QObject::tr("Run %1 stages").arg(stages.size());
}

void apply(CaseDocument& document, const std::filesystem::path& folder, Progress& progress) {
  const std::scoped_lock lock{progress.mutex};
  if (document.folder() != folder) return;  // another case was opened meanwhile
  std::vector<Stage> taken;
  if (!progress.ended.empty())
    document.edit(labelOf(progress.ended),
                  [&](Case& c) { taken = mergeResults(c, progress.computed, progress.ended); });
  if (progress.error)
    emit document.rejected(QString::fromStdString(*progress.error));
  else if (taken.size() < progress.ended.size())
    emit document.rejected(
        QObject::tr("%1: its inputs changed while it ran, so the result was not used. Run it again.")
            .arg(QString::fromStdString(titleOf(progress.ended[taken.size()]))));
}

void compute(Progress& progress, const std::vector<Stage>& stages, const PipelineContext& context, const Job& job) {
  Case c = progress.computed;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const std::string title = titleOf(stages[i]);
    Job part;
    part.stop = job.stop;
    part.report_to = [&](double fraction, std::string_view what) {
      job.report((double(i) + std::clamp(fraction, 0.0, 1.0)) / double(stages.size()),
                 what.empty() || what == title ? title : title + ": " + std::string{what});
    };
    part.report(0, "");
    Outcome outcome = Outcome::NotRun;
    try {
      c = runStage(c, stages[i], context, part);
      if (const auto record = c.stages.find(stages[i]); record != c.stages.end()) outcome = record->second.outcome;
    } catch (const InputError& error) {
      const std::scoped_lock lock{progress.mutex};
      progress.error = error.what();
      return;
    }
    if (job.cancelled() || outcome == Outcome::Cancelled) return;
    const std::scoped_lock lock{progress.mutex};
    progress.computed = c;
    progress.ended.push_back(stages[i]);
    if (outcome != Outcome::Converged) return;
  }
}

}  // namespace

std::vector<Stage> mergeResults(Case& c, const Case& computed, std::span<const Stage> stages) {
  std::vector<Stage> taken;
  for (const Stage stage : stages) {
    const auto record = computed.stages.find(stage);
    if (record == computed.stages.end() || record->second.input_hash != inputHash(c, stage)) break;
    copyResult(c, computed, stage);
    taken.push_back(stage);
  }
  return taken;
}

std::vector<Stage> stagesToRun(const CaseDocument& document) {
  std::vector<Stage> stages;
  for (const Stage stage : kStages)
    if (!stages.empty() || document.stateOf(stage) != StageState::Done) stages.push_back(stage);
  return stages;
}

bool runStages(CaseDocument& document, JobRunner& runner, const StageServices& services, std::vector<Stage> stages) {
  if (stages.empty() || !document.isOpen()) return true;
  const auto progress = std::make_shared<Progress>();
  progress->computed = document.current();
  const auto folder = document.folder();
  const auto applyAll = [&document, folder, progress] { apply(document, folder, *progress); };
  const QString title = labelOf(stages);
  return runner.start(
      title,
      [=](const Job& job) -> JobRunner::Finish {
        const auto reference = services.reference();
        compute(*progress, stages,
                {services.resource_dir, folder, reference.get(), services.retargeting, services.write_report}, job);
        return applyAll;
      },
      applyAll);
}

}  // namespace sinew
