#pragma once
#include <QCoreApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>
#include <functional>

namespace sinew::test {

/// Lets events run until `done` answers true; false after `timeout_ms`.
inline bool waitUntil(const std::function<bool()>& done, int timeout_ms = 5000) {
  QElapsedTimer clock;
  clock.start();
  while (!done()) {
    if (clock.elapsed() > timeout_ms) return false;
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
