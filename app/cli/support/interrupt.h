#pragma once
#include <stop_token>
#include <thread>

namespace sinew {

/// Turns Ctrl-C (SIGINT, SIGTERM) into a stop request, so that work ends in order and leaves no half-written file.
/// The second one ends the program at once; files are replaced atomically, so that this is safe too.
/// To be made before any other thread, which then inherits the blocked signals.
class Interrupt {
 public:
  Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  ~Interrupt();

  std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  std::jthread watcher_;
};

}  // namespace sinew
