#pragma once
#include <Eigen/Core>

namespace sinew {

/// Where a Newton step leads within low <= x <= high: variables that would leave stop at their bound while the others
/// are solved again. `hessian` positive definite.
Eigen::VectorXd boundedStep(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                            double low, double high);

}  // namespace sinew
