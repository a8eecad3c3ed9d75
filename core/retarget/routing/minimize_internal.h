#pragma once
#include <Eigen/Core>
#include <functional>
#include <limits>

#include "core/job.h"
#include "core/retarget/routing/unit_problem_internal.h"

namespace sinew {

struct Minimum {
  Eigen::VectorXd x;
  double energy = 0;
  int iterations = 0;
};

/// Levenberg-Marquardt from `from`. Small dense problems: a general solver's set-up would cost as much as the
/// solution.
Minimum leastSquares(const UnitProblem& problem, Objective objective, const Eigen::VectorXd& from,
                     int most_iterations, double tolerance, const std::stop_token& stop);

/// Gradient descent with a line search whose step grows after success (Ryu et al.).
struct DescentOptions {
  bool finite_differences = false;  ///< as the paper; else the exact gradient
  int most_iterations = 200;
  double tolerance = 1e-6;   ///< relative gain of an iteration
  double first_step = 1e-3;  ///< of the line search, in the unit of the variables: metres of a path point
};
Minimum descent(const UnitProblem& problem, const Eigen::VectorXd& from, const DescentOptions& options,
                const std::stop_token& stop);

/// The same for any function, between bounds.
struct DescentProblem {
  std::function<double(const Eigen::VectorXd&)> energy;
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x, double energy)> gradient;
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};
Minimum descent(const DescentProblem& problem, const Eigen::VectorXd& from, const DescentOptions& options,
                const std::stop_token& stop);

}  // namespace sinew
