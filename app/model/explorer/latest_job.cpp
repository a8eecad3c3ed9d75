#include "app/model/explorer/latest_job.h"

#include <utility>

namespace sinew {

LatestJob::LatestJob(QObject* parent) : QObject{parent} {
  connect(&runner_, &JobRunner::released, this, [this] {
    if (auto next = std::exchange(pending_, nullptr))
      runner_.start(pending_title_, std::move(next));
    else
      emit idle();
  });
}

void LatestJob::post(const QString& title, JobRunner::Work work, bool abandon_running) {
  if (runner_.isBusy()) {
    pending_ = std::move(work);
    pending_title_ = title;
    if (abandon_running) runner_.cancel();
  } else {
    runner_.start(title, std::move(work));
  }
}

void LatestJob::cancel() {
  pending_ = nullptr;
  runner_.cancel();
}

}  // namespace sinew
