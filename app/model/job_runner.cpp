#include "app/model/job_runner.h"

#include <QMetaObject>
#include <QTimer>
#include <chrono>
#include <optional>

#include "core/error.h"

namespace sinew {

struct JobRunner::Run {
  Work work;
  Finish on_cancel;
  Finish finish;                 // written by the thread before it posts its end, read after
  std::optional<QString> error;  // likewise
  bool cancelled = false;        // GUI thread only
};

JobRunner::JobRunner(QObject* parent) : QObject{parent} {}

JobRunner::~JobRunner() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

bool JobRunner::start(const QString& title, Work work, Finish on_cancel) {
  if (isBusy()) return false;
  if (thread_.joinable()) thread_.join();
  auto run = std::make_shared<Run>();
  run->work = std::move(work);
  run->on_cancel = std::move(on_cancel);
  run_ = run;
  title_ = title;
  shown_ = true;
  emit started(title);
  thread_ = std::jthread{[this, run](std::stop_token stop) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point last{};
    Job job;
    job.stop = stop;
    job.report_to = [this, run, last](double fraction, std::string_view stage) mutable {
      const auto now = Clock::now();
      if (now - last < std::chrono::milliseconds{kReportInterval_ms}) return;
      last = now;
      QMetaObject::invokeMethod(
          this,
          [this, run, fraction, text = QString::fromUtf8(stage.data(), qsizetype(stage.size()))] {
            if (run == run_ && shown_ && !run->cancelled) emit progressed(fraction, text);
          },
          Qt::QueuedConnection);
    };
    try {
      run->finish = run->work(job);
    } catch (const InputError& error) {
      run->error = QString::fromUtf8(error.what());
    } catch (const std::exception& error) {
      run->error = QStringLiteral("Internal fault: ") + QString::fromUtf8(error.what());
    }
    run->work = nullptr;  // what it captured goes on this thread
    QMetaObject::invokeMethod(
        this, [this, run] { finish(run); }, Qt::QueuedConnection);
  }};
  return true;
}

void JobRunner::cancel() {
  if (!shown_ || run_->cancelled) return;
  const auto run = run_;
  run->cancelled = true;
  thread_.request_stop();
  emit cancelling();
  QTimer::singleShot(kGrace_ms, Qt::PreciseTimer, this, [this, run] {
    if (run == run_ && shown_) answer(Ending::Cancelled, {});
  });
}

void JobRunner::finish(const std::shared_ptr<Run>& run) {
  if (run != run_) return;
  if (thread_.joinable()) thread_.join();
  run_.reset();
  if (shown_) {
    if (run->cancelled) {
      answer(Ending::Cancelled, {});
    } else if (run->error) {
      answer(Ending::Failed, *run->error);
    } else {
      answer(Ending::Done, {});
      if (run->finish) run->finish();
    }
  }
  if (run->cancelled && run->on_cancel) run->on_cancel();
  emit released();
}

void JobRunner::answer(Ending ending, const QString& message) {
  shown_ = false;
  emit ended(ending, message);
}

}  // namespace sinew
