#pragma once
#include "core/job.h"

namespace sinew {

/// What the command line answers to the shell.
enum class ExitStatus {
  Done = 0,
  Fault = 1,         ///< ours
  Unusable = 2,      ///< input or usage
  NotConverged = 3,  ///< ran, but did not converge or was cancelled
};

constexpr ExitStatus statusOf(Outcome outcome) {
  return outcome == Outcome::Converged ? ExitStatus::Done : ExitStatus::NotConverged;
}

}  // namespace sinew
