#pragma once
#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <thread>

#include "core/job.h"

namespace sinew {

/// Runs one long computation at a time beside the window.
class JobRunner : public QObject {
  Q_OBJECT
 public:
  enum class Ending { Done, Cancelled, Failed };
  Q_ENUM(Ending)

  /// What the computation leaves to do on the GUI thread: applying its result. May be empty.
  using Finish = std::function<void()>;
  /// Runs on a thread of its own; must touch nothing but what it was given by value.
  using Work = std::function<Finish(const Job&)>;

  explicit JobRunner(QObject* parent = nullptr);
  /// Asks the computation to stop and waits for it.
  ~JobRunner() override;

  /// False, and nothing happens, while a computation runs or a cancelled one has not let go of its thread yet.
  /// `on_cancel` runs on the GUI thread instead of Finish when the person cancelled.
  bool start(const QString& title, Work work, Finish on_cancel = {});
  /// The window has its answer, ended(Cancelled), within kGrace_ms, also if the computation is slow to stop: then it
  /// is abandoned, and whatever it still returns is dropped.
  void cancel();

  bool isRunning() const { return shown_; }
  bool isBusy() const { return run_ != nullptr; }  ///< running, or abandoned and still stopping
  const QString& title() const { return title_; }

  static constexpr int kGrace_ms = 120;          ///< with the event loop's share well below 200 ms
  static constexpr int kReportInterval_ms = 50;  ///< at most 20 reports a second

 signals:
  void started(const QString& title);
  void progressed(double fraction, const QString& stage);
  void cancelling();
  /// `message` is empty but for Failed: one line for the person.
  void ended(Ending ending, const QString& message);
  void released();  ///< the thread is free again

 private:
  struct Run;
  void finish(const std::shared_ptr<Run>& run);
  void answer(Ending ending, const QString& message);

  std::shared_ptr<Run> run_;
  std::jthread thread_;
  QString title_;
  bool shown_ = false;
};

}  // namespace sinew
