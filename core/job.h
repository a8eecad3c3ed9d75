#pragma once
#include <functional>
#include <stop_token>
#include <string_view>

namespace sinew {

/// How a computation ended. Anything but Converged leaves the numbers of its result NaN or empty.
enum class Outcome { NotRun, Converged, NotConverged, Cancelled };

constexpr std::string_view nameOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::NotRun:
      return "not_run";
    case Outcome::Converged:
      return "converged";
    case Outcome::NotConverged:
      return "not_converged";
    case Outcome::Cancelled:
      return "cancelled";
  }
  return "";
}

/// Progress and stop of a long computation: the last parameter of every function that may take long.
/// The default does nothing. `report` is called on the thread that computes.
struct Job {
  std::function<void(double fraction, std::string_view stage)> report_to;
  std::stop_token stop;

  void report(double fraction, std::string_view stage) const {
    if (report_to) report_to(fraction, stage);
  }
  bool cancelled() const { return stop.stop_requested(); }
};

}  // namespace sinew
