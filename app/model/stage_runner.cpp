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

QString labelOf(const std::vector<Stage>& stages) {
  if (stages.size() == 1) return QObject::tr("Run %1").arg(QString::fromStdString(titleOf(stages.front())).toLower());
  return QObject::tr("Run %1 stages").arg(stages.size());
}

void apply(CaseDocument& document, const std::filesystem::path& folder, Progress& progress) {
  const std::scoped_lock lock{progress.mutex};
  if (document.folder() != folder) return;  // another case was opened meanwhile
  std::vector<Stage> taken;
  if (!progress.ended.empty())
    document.edit(labelOf(progress.ended), [&](Case& c) {
      taken = mergeResults(c, progress.computed, progress.ended, document.resourceDir());
    });
  if (progress.error)
    emit document.rejected(QString::fromStdString(*progress.error));
  else if (taken.size() < progress.ended.size())
    emit document.rejected(
        QObject::tr("%1: its inputs changed while it ran, so the result was not used. Run it again.")
            .arg(QString::fromStdString(titleOf(progress.ended[taken.size()]))));
}

void compute(Progress& progress, const RunRequest& request, const PipelineContext& context, const Job& job) {
  RunObserver observer;
  observer.ended = [&](const Case& c, Stage stage) {
    if (job.cancelled() || c.stages.at(stage).outcome == Outcome::Cancelled) return;
    const std::scoped_lock lock{progress.mutex};
    progress.computed = c;
    progress.ended.push_back(stage);
  };
  const Case start = progress.computed;
  const CaseRun run = runCase(start, request, context, observer, job);
  if (!run.refused) return;
  const std::scoped_lock lock{progress.mutex};
  progress.error = run.refused->what();
}

}  // namespace

bool hasStagesToRun(const CaseDocument& document) {
  return std::ranges::any_of(kStages, [&](Stage stage) { return document.stateOf(stage) != StageState::Done; });
}

bool runStages(CaseDocument& document, JobRunner& runner, const StageServices& services, const RunRequest& request) {
  if (!document.isOpen()) return true;
  const auto progress = std::make_shared<Progress>();
  progress->computed = document.current();
  const auto folder = document.folder();
  const auto applyAll = [&document, folder, progress] { apply(document, folder, *progress); };
  const QString title = request.from ? labelOf({*request.from}) : QObject::tr("Run stages");
  return runner.start(
      title,
      [=](const Job& job) -> JobRunner::Finish {
        const auto reference = services.reference();
        compute(*progress, request,
                {services.resource_dir, folder, reference.get(), services.retargeting, services.write_report}, job);
        return applyAll;
      },
      applyAll);
}

}  // namespace sinew
