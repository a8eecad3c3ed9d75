#include "core/optimization/bounded_least_squares.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace sinew {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

enum class Place { AtLower, Free, AtUpper };

/// The problem, and the point on its way to the optimum.
class ActiveSet {
 public:
  ActiveSet(const MatrixXd& A, const VectorXd& b, const VectorXd& lower, const VectorXd& upper,
            const BoundedLeastSquaresOptions& options)
      : A_{A}, b_{b}, lower_{lower}, upper_{upper}, options_{options}, lengths_{A.colwise().norm()} {}

  void startAt(const VectorXd& start) {
    x_ = (start.size() == 0 ? VectorXd::Zero(A_.cols()) : start).cwiseMax(lower_).cwiseMin(upper_);
    place_.assign(static_cast<std::size_t>(A_.cols()), Place::Free);
    for (Index i = 0; i < x_.size(); ++i) {
      // Without a start a variable rests at its nearer bound; a variable without bounds is free.
      if (start.size() == 0 && std::isfinite(lower_[i]) && std::isfinite(upper_[i]))
        x_[i] = std::abs(lower_[i]) <= std::abs(upper_[i]) ? lower_[i] : upper_[i];
      else if (start.size() == 0 && (std::isfinite(lower_[i]) || std::isfinite(upper_[i])))
        x_[i] = std::isfinite(lower_[i]) ? lower_[i] : upper_[i];
      if (x_[i] <= lower_[i])
        place(i) = Place::AtLower;
      else if (x_[i] >= upper_[i])
        place(i) = Place::AtUpper;
    }
  }

  /// Steps until the KKT conditions hold. @returns false if the iterations run out.
  bool solve() {
    for (; iterations_ < options_.max_iterations; ++iterations_) {
      const std::vector<Index> free = freeVariables();
      const VectorXd target = unboundedOptimum(free);
      if (moveTowards(free, target)) continue;  // a bound stopped it and is active now
      if (!releaseOne()) return true;
    }
    return false;
  }

  const VectorXd& x() const { return x_; }
  int iterations() const { return iterations_; }

 private:
  Place& place(Index i) { return place_[static_cast<std::size_t>(i)]; }

  std::vector<Index> freeVariables() {
    std::vector<Index> free;
    for (Index i = 0; i < x_.size(); ++i)
      if (place(i) == Place::Free) free.push_back(i);
    return free;
  }

  /// Optimum of the free variables while the others stay.
  VectorXd unboundedOptimum(const std::vector<Index>& free) {
    const auto count = static_cast<Index>(free.size());
    if (count == 0) return {};
    const MatrixXd F = A_(Eigen::all, free);
    const VectorXd rest = b_ - A_ * x_ + F * x_(free);
    const double w = options_.regularization;
    if (w == 0) return F.completeOrthogonalDecomposition().solve(rest);  // of least length if not unique
    // The smaller of the two normal systems.
    if (count <= F.rows()) {
      MatrixXd gram = F.transpose() * F;
      gram.diagonal().array() += w;
      return gram.llt().solve(F.transpose() * rest);
    }
    MatrixXd gram = F * F.transpose();
    gram.diagonal().array() += w;
    return F.transpose() * gram.llt().solve(rest);
  }

  /// Goes to `target`, or as far as the first bound lets it. @returns whether a bound became active.
  bool moveTowards(const std::vector<Index>& free, const VectorXd& target) {
    double share = 1;
    Index first = -1;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const Index i = free[k];
      const double goal = target[static_cast<Index>(k)], step = goal - x_[i];
      const double bound = step < 0 ? lower_[i] : upper_[i];
      const bool beyond = step < 0 ? goal < bound : goal > bound;
      if (!beyond) continue;
      const double reach = (bound - x_[i]) / step;
      if (first < 0 || reach < share) {
        share = std::clamp(reach, 0.0, 1.0);
        first = i;
      }
    }
    if (released_ >= 0 && first == released_ && share == 0)
      held_[static_cast<std::size_t>(first)] =
          true;  // sent straight back, by rounding: waits until another has moved
    else if (released_ >= 0 && share > 0)
      held_.assign(held_.size(), false);
    released_ = -1;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const Index i = free[k];
      const double goal = target[static_cast<Index>(k)];
      x_[i] += share * (goal - x_[i]);
      const bool down = goal<lower_[i], up = goal> upper_[i];
      if (i == first || (down && x_[i] <= lower_[i]) || (up && x_[i] >= upper_[i])) {
        place(i) = down ? Place::AtLower : Place::AtUpper;
        x_[i] = down ? lower_[i] : upper_[i];
      }
    }
    return first >= 0;
  }

  /// Lets go the active bound that the objective pushes away from hardest. @returns false if there is none.
  bool releaseOne() {
    const VectorXd residual = b_ - A_ * x_;
    const VectorXd downhill = A_.transpose() * residual - options_.regularization * x_;
    const double scale = std::max(b_.norm(), residual.norm());
    Index best = -1;
    double strongest = options_.tolerance;
    for (Index i = 0; i < x_.size(); ++i) {
      if (place(i) == Place::Free || held_[static_cast<std::size_t>(i)] || lower_[i] == upper_[i]) continue;
      const double push = (place(i) == Place::AtLower ? downhill[i] : -downhill[i]) / gradientUnit(i, scale);
      if (push > strongest) {
        strongest = push;
        best = i;
      }
    }
    released_ = best;
    if (best >= 0) place(best) = Place::Free;
    return best >= 0;
  }

  /// What a gradient is measured in; 1 where a column or the whole problem vanishes.
  double gradientUnit(Index i, double scale) const {
    const double unit = lengths_[i] * scale;
    return unit > 0 ? unit : 1;
  }

  const MatrixXd& A_;
  const VectorXd &b_, &lower_, &upper_;
  const BoundedLeastSquaresOptions& options_;
  VectorXd lengths_, x_;
  std::vector<Place> place_;
  std::vector<bool> held_ = std::vector<bool>(static_cast<std::size_t>(A_.cols()), false);
  Index released_ = -1;
  int iterations_ = 0;
};

}  // namespace

double kktViolation(const MatrixXd& A, const VectorXd& b, const VectorXd& lower, const VectorXd& upper,
                    double regularization, const VectorXd& x) {
  const VectorXd residual = b - A * x;
  const VectorXd downhill = A.transpose() * residual - regularization * x;
  const double scale = std::max(b.norm(), residual.norm());
  double worst = 0;
  for (Index i = 0; i < x.size(); ++i) {
    worst = std::max({worst, lower[i] - x[i], x[i] - upper[i]});
    const double unit = A.col(i).norm() * scale;
    const double slope = downhill[i] / (unit > 0 ? unit : 1);
    if (x[i] > lower[i]) worst = std::max(worst, -slope);  // could go down
    if (x[i] < upper[i]) worst = std::max(worst, slope);   // could go up
  }
  return worst;
}

BoundedLeastSquaresResult solveBoundedLeastSquares(const MatrixXd& A, const VectorXd& b, const VectorXd& lower,
                                                   const VectorXd& upper, const BoundedLeastSquaresOptions& options,
                                                   const VectorXd& start) {
  const Index n = A.cols();
  require(b.size() == A.rows() && lower.size() == n && upper.size() == n && (start.size() == 0 || start.size() == n),
          "bounded least squares: sizes of A, b, lower, upper, start");
  require(A.allFinite() && b.allFinite() && (start.size() == 0 || start.allFinite()),
          "bounded least squares: finite A, b, start");
  require((lower.array() <= upper.array()).all(), "bounded least squares: lower <= upper");
  require(options.regularization >= 0, "bounded least squares: regularization >= 0");

  ActiveSet search{A, b, lower, upper, options};
  search.startAt(start);
  BoundedLeastSquaresResult result;
  const bool solved = search.solve();
  result.outcome = solved ? Outcome::Converged : Outcome::NotConverged;
  result.iterations = search.iterations();
  if (!solved) {
    result.x = VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
    result.residual = VectorXd::Constant(b.size(), std::numeric_limits<double>::quiet_NaN());
    return result;
  }
  result.x = search.x();
  result.residual = b - A * result.x;
  result.kkt_violation = kktViolation(A, b, lower, upper, options.regularization, result.x);
  return result;
}

}  // namespace sinew
