#pragma once
#include <QCoreApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>
#include <ctime>
#include <functional>

namespace sinew::test {

/// Lets events run until `done` answers true; false after this process has worked for `limit_ms` meanwhile. Processor
/// time of all threads, not the wall's: on a loaded machine a stage takes longer, but no more work.
inline bool waitUntil(const std::function<bool()>& done, int limit_ms = 10'000) {
  const std::clock_t start = std::clock();
  while (!done()) {
    if (1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC > limit_ms) return false;
    QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
  }
  return true;
}

/// Lets events run for a while.
inline void letEventsRun(int duration_ms) {
  QElapsedTimer clock;
  clock.start();
  while (clock.elapsed() < duration_ms) QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
}

/// The one application object of a test executable without a window.
inline QCoreApplication& coreApplication() {
  static int argc = 1;
  static char name[] = "sinew-test";
  static char* argv[] = {name, nullptr};
  static QCoreApplication application{argc, argv};
  return application;
}

}  // namespace sinew::test
