#pragma once
#include <QObject>

#include "app/model/job_runner.h"

namespace sinew {

/// Computations of which only the newest matters: while one runs, the next request waits, and a still newer one takes
/// its place. So a slider can be dragged, and its last value is always computed.
class LatestJob : public QObject {
  Q_OBJECT
 public:
  explicit LatestJob(QObject* parent = nullptr);

  /// Runs `work` as soon as the running computation has ended; `abandon_running` stops that one, its result is
  /// dropped.
  void post(const QString& title, JobRunner::Work work, bool abandon_running = false);
  /// Stops the running one and forgets the waiting one.
  void cancel();
  bool isBusy() const { return runner_.isBusy() || pending_; }
  const JobRunner& runner() const { return runner_; }  ///< for its signals

 signals:
  void idle();  ///< nothing runs and nothing waits any more

 private:
  JobRunner::Work pending_;
  QString pending_title_;
  JobRunner runner_;  ///< last: its thread ends before the rest goes
};

}  // namespace sinew
