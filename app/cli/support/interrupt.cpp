#include "app/cli/support/interrupt.h"

#include <pthread.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include "app/cli/support/exit_status.h"

namespace sinew {
namespace {

sigset_t endingSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

void watch(const std::stop_token& program_ends, std::stop_source work) {
  const sigset_t set = endingSignals();
  const timespec interval{.tv_sec = 0, .tv_nsec = 50'000'000};
  while (!program_ends.stop_requested()) {
    if (sigtimedwait(&set, nullptr, &interval) < 0) continue;  // nothing came
    if (work.stop_requested()) _exit(static_cast<int>(ExitStatus::NotConverged));
    work.request_stop();
  }
}

}  // namespace

Interrupt::Interrupt() {
  const sigset_t set = endingSignals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  watcher_ = std::jthread{[work = stop_](const std::stop_token& program_ends) { watch(program_ends, work); }};
}

Interrupt::~Interrupt() {
  watcher_.request_stop();
  watcher_.join();
  const sigset_t set = endingSignals();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace sinew
