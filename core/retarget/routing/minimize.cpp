#include <Eigen/Cholesky>
#include <algorithm>

#include "core/retarget/routing/minimize_internal.h"

namespace sinew {

Minimum leastSquares(const UnitProblem& problem, Objective objective, const Eigen::VectorXd& from,
                     int most_iterations, double tolerance, const std::stop_token& stop) {
  constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-7;
  constexpr int kMostTrials = 6;
  Minimum best{from};
  UnitProblem::Expansion e;
  Eigen::MatrixXd damped;
  Eigen::LDLT<Eigen::MatrixXd> factored;
  Eigen::VectorXd step, x;
  problem.expand(best.x, objective, e);
  best.energy = e.energy;
  double damping = kFirstDamping;
  while (best.iterations < most_iterations && !stop.stop_requested()) {
    ++best.iterations;
    const double before = best.energy;
    bool better = false;
    for (int trial = 0; trial < kMostTrials && !better; ++trial) {
      damped = e.hessian;
      // A point that may not move has a zero row; the added constant leaves it where it is.
      damped.diagonal().array() = damped.diagonal().array() * (1 + damping) + 1e-12;
      step = factored.compute(damped).solve(e.gradient);
      if (0.5 * e.gradient.dot(step) < tolerance * before) break;  // all that can be hoped for
      x = best.x - step;
      const double energy = problem.energy(x, objective);
      better = energy < best.energy && !problem.turnsAround(best.x, x);
      if (better) {
        best.x.swap(x);
        best.energy = energy;
        damping = std::max(kLeastDamping, damping * 0.3);
      } else {
        damping *= 10;
      }
    }
    if (!better || before - best.energy < tolerance * before) break;
    problem.expand(best.x, objective, e);
  }
  return best;
}

namespace {

/// Forward differences.
Eigen::VectorXd differences(const UnitProblem& problem, const Eigen::VectorXd& x, double energy) {
  constexpr double kStep_m = 1e-5;
  Eigen::VectorXd gradient(x.size()), moved = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    moved[i] = x[i] + kStep_m;
    gradient[i] = (problem.energy(moved) - energy) / kStep_m;
    moved[i] = x[i];
  }
  return gradient;
}

}  // namespace

Minimum descent(const UnitProblem& problem, const Eigen::VectorXd& from, const DescentOptions& options,
                const std::stop_token& stop) {
  const auto gradient = [&](const Eigen::VectorXd& x, double energy) {
    if (options.finite_differences) return differences(problem, x, energy);
    Eigen::VectorXd exact;
    problem.energy(x, exact);
    return exact;
  };
  return descent({[&](const Eigen::VectorXd& x) { return problem.energy(x); }, gradient}, from, options, stop);
}

Minimum descent(const DescentProblem& problem, const Eigen::VectorXd& from, const DescentOptions& options,
                const std::stop_token& stop) {
  constexpr int kMostTrials = 14;
  constexpr double kGrowth = 1.7, kShrink = 0.4, kSufficient = 1e-4, kFlat = 1e-7;
  Minimum best{from, problem.energy(from)};
  double length = options.first_step;
  while (best.iterations < options.most_iterations && !stop.stop_requested()) {
    ++best.iterations;
    const Eigen::VectorXd gradient = problem.gradient(best.x, best.energy);
    const double slope = gradient.norm();
    if (slope < kFlat) break;
    const double before = best.energy;
    bool better = false;
    for (int trial = 0; trial < kMostTrials && !better; ++trial) {
      const Eigen::VectorXd x = (best.x - gradient * (length / slope)).cwiseMax(problem.low).cwiseMin(problem.high);
      const double energy = problem.energy(x);
      better = energy < best.energy - kSufficient * length * slope;
      if (better) {
        best.x = x;
        best.energy = energy;
        length *= kGrowth;
      } else {
        length *= kShrink;
      }
    }
    if (!better || before - best.energy < options.tolerance * before) break;
  }
  return best;
}

}  // namespace sinew
