#pragma once
#include <ceres/iteration_callback.h>
#include <ceres/solver.h>

#include <algorithm>
#include <string>
#include <utility>

#include "core/job.h"

namespace sinew {

/// The only bridge between a Job and a Ceres solver: reports every iteration as a share of [from, to], and ends the
/// solve after the iteration in which the stop was requested. Add it to Solver::Options::callbacks; use outcomeOf()
/// to read how the solve ended. For .cpp files only: Ceres stays out of public headers.
class CeresJob : public ceres::IterationCallback {
 public:
  CeresJob(const Job& job, std::string stage, int max_iterations, double from = 0, double to = 1)
      : job_{job}, stage_{std::move(stage)}, max_iterations_{std::max(1, max_iterations)}, from_{from}, to_{to} {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    if (job_.cancelled()) return ceres::SOLVER_ABORT;
    const double done = std::min(1.0, static_cast<double>(iteration.iteration) / max_iterations_);
    job_.report(from_ + (to_ - from_) * done, stage_);
    return ceres::SOLVER_CONTINUE;
  }

 private:
  const Job& job_;
  std::string stage_;
  int max_iterations_;
  double from_, to_;
};

/// A stopped solve is Cancelled, never a success; out of iterations or unable to step is NotConverged.
inline Outcome outcomeOf(const ceres::Solver::Summary& summary) {
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
    case ceres::USER_SUCCESS:
      return Outcome::Converged;
    case ceres::USER_FAILURE:
      return Outcome::Cancelled;
    case ceres::NO_CONVERGENCE:
    case ceres::FAILURE:
      break;
  }
  return Outcome::NotConverged;
}

/// Solver settings of the house: quiet, one thread (deterministic), every iteration reported to `monitor`.
inline ceres::Solver::Options solverOptions(CeresJob& monitor, int max_iterations,
                                            ceres::LinearSolverType linear_solver = ceres::DENSE_QR) {
  ceres::Solver::Options options;
  options.max_num_iterations = max_iterations;
  options.linear_solver_type = linear_solver;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  options.callbacks.push_back(&monitor);
  return options;
}

}  // namespace sinew
