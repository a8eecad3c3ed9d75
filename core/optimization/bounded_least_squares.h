#pragma once
#include <Eigen/Core>
#include <limits>

#include "core/job.h"

namespace sinew {

// Bounded-variable linear least squares by a primal active set (Lawson & Hanson 1974, Stark & Parker 1995):
//   minimise |A x - b|^2 + regularization |x|^2   subject to   lower <= x <= upper.
// What activations are found with: A = effect of full activation of every unit, b = what is wanted. The optimum meets
// the Karush-Kuhn-Tucker conditions exactly up to rounding: bounds that are active are hit, not approached.

struct BoundedLeastSquaresOptions {
  double regularization = 0;  ///< >= 0; above 0 the solution is unique
  /// KKT conditions hold to this share of (column's length) x (length of b, or of the residual where that is larger).
  double tolerance = 1e-10;
  int max_iterations = 10'000;  ///< changes of the active set; a few per variable are usual
};

struct BoundedLeastSquaresResult {
  Outcome outcome = Outcome::NotRun;
  Eigen::VectorXd x;         ///< NaN unless converged
  Eigen::VectorXd residual;  ///< b - A x
  /// Largest violation of the KKT conditions, as `tolerance` measures it.
  double kkt_violation = std::numeric_limits<double>::quiet_NaN();
  int iterations = 0;
};

/// @param A m x n; any rank, m and n as they come.
/// @param lower, upper n entries each, lower <= upper; upper may be +infinity, lower may be -infinity.
/// @param start warm start: a point whose active bounds are tried first (it is moved between the bounds). Empty:
/// every variable at the bound nearer to 0. A wrong size, NaN or lower > upper is a bug of the caller.
BoundedLeastSquaresResult solveBoundedLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                                   const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                                   const BoundedLeastSquaresOptions& options = {},
                                                   const Eigen::VectorXd& start = {});

/// Largest violation of the KKT conditions at x: gradients of free variables, gradients that push off an active
/// bound, distance out of the bounds; each gradient divided by (column's length) x max(|b|, |A x - b|). 0 at the
/// optimum.
double kktViolation(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& lower,
                    const Eigen::VectorXd& upper, double regularization, const Eigen::VectorXd& x);

}  // namespace sinew
