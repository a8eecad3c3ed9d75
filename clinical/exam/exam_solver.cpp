#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "clinical/exam/exam_problem_internal.h"
#include "core/ceres_job_internal.h"

namespace sinew {
namespace {

double leastFactor(Scaled scaled) {
  return scaled == Scaled::FiberAndTendon ? kLeastFactor : 0.1;
}
double mostFactor(Scaled scaled) {
  return scaled == Scaled::FiberAndTendon ? kMostFactor : 3;
}
/// The same pull in metres of muscle.
double priorOf(const FreeGroup& group, Scaled scaled) {
  return scaled == Scaled::FiberAndTendon ? kFactorPrior : kFactorPrior / group.mean_fiber_share;
}

/// (place where the body is held - place to be met) / SD of the measurement [-], one a test; then the pulls
/// (factor - prior mean) / prior SD, one a group. The place solves excess(place, factors) = 0, so its slope is
/// -(d excess / d factor) / (d excess / d place).
class ExamCost : public ceres::CostFunction {
 public:
  explicit ExamCost(const SideProblem& problem) : problem_{problem}, near_(problem.tests->size(), NAN) {
    set_num_residuals(int(problem.tests->size() + problem.groups->size()));
    mutable_parameter_block_sizes()->push_back(int(problem.groups->size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const std::size_t tests = problem_.tests->size(), count = problem_.groups->size();
    const std::vector<double> x(parameters[0], parameters[0] + count);
    double* J = jacobians ? jacobians[0] : nullptr;
    if (J) std::fill(J, J + (tests + count) * count, 0.0);
    const LengthFactors factors = lengthFactors(*problem_.groups, x, problem_.scaled);
    for (std::size_t i = 0; i < tests; ++i) {
      const MeasuredTest& test = (*problem_.tests)[i];
      const double threshold_Nm = problem_.threshold_scale * test.threshold_Nm;
      const double place = std::isnan(near_[i]) ? test.sweep->freeEnd_deg(threshold_Nm, factors)
                                                : test.sweep->freeEndNear_deg(near_[i], threshold_Nm, factors);
      near_[i] = place;
      const double sd_deg = problem_.sds_deg.empty() ? test.test->form->measurement_sd_deg : problem_.sds_deg[i];
      if (const double faded_to = fadedTo(i); std::isfinite(faded_to)) {
        residuals[i] = fadedResidual(test, faded_to, x, J ? J + i * count : nullptr);
        continue;
      }
      residuals[i] = (place - problem_.places[i]) / sd_deg;
      if (J) addSlopes(test, place, threshold_Nm, x, 1 / sd_deg, J + i * count);
    }
    for (std::size_t g = 0; g < count; ++g) {
      const double sd = priorOf((*problem_.groups)[g], problem_.scaled);
      residuals[tests + g] = (x[g] - problem_.prior_means[g]) / sd;
      if (J) J[(tests + g) * count + g] = 1 / sd;
    }
    return true;
  }

 private:
  double fadedTo(std::size_t test) const { return problem_.faded_to.empty() ? NAN : problem_.faded_to[test]; }

  /// (factor - the one that is allowed) / what an SD of the measurement is worth where it fades in. Beside a stiff
  /// capsule a place says next to nothing about lengths, and the pull to 1 would win until it suddenly does not.
  double fadedResidual(const MeasuredTest& test, double faded_to, const std::vector<double>& x, double* row) const {
    const auto first = std::size_t(test.groups.front());
    // The same change of length by the fibre alone.
    const double share = problem_.scaled == Scaled::FiberOnly ? (*problem_.groups)[first].mean_fiber_share : 1;
    const double sd = kSteepest_per_deg * test.test->form->measurement_sd_deg / share;
    if (row) row[first] = 1 / sd;
    return (x[first] - (1 + (faded_to - 1) / share)) / sd;
  }

  void addSlopes(const MeasuredTest& test, double place, double threshold_Nm, const std::vector<double>& x,
                 double weight, double* row) const {
    constexpr double kPlace_deg = 0.02, kFactor = 1e-4;
    const auto excess = [&](double s, const std::vector<double>& f) {
      return test.sweep->excess(s, threshold_Nm, lengthFactors(*problem_.groups, f, problem_.scaled));
    };
    if (std::abs(excess(place, x)) > 1e-4) return;  // nothing holds within the table: no slope
    const double along = (excess(place + kPlace_deg, x) - excess(place - kPlace_deg, x)) / (2 * kPlace_deg);
    if (!(std::abs(along) > 1e-6)) return;
    std::vector<double> f = x;
    for (std::size_t g = 0; g < x.size(); ++g) {
      if (std::ranges::none_of((*problem_.groups)[g].units, [&](int u) { return test.sweep->stretches(u); }))
        continue;
      f[g] = x[g] + kFactor;
      const double longer = excess(place, f);
      f[g] = x[g] - kFactor;
      row[g] = -weight * (longer - excess(place, f)) / (2 * kFactor) / along;
      f[g] = x[g];
    }
  }

  const SideProblem& problem_;
  mutable std::vector<double> near_;  // last places: the next are looked for near them
};

}  // namespace

SideSolution solveSide(const SideProblem& problem, const std::vector<double>& start, const Job& job, bool nearby) {
  SideSolution solution{.outcome = Outcome::Converged, .factors = start};
  if (start.empty()) return solution;
  const double least = leastFactor(problem.scaled), most = mostFactor(problem.scaled);
  for (double& f : solution.factors) f = std::clamp(f, least, most);
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new ExamCost{problem}, nullptr, solution.factors.data());
  for (int g = 0; g < int(start.size()); ++g) {
    ceres_problem.SetParameterLowerBound(solution.factors.data(), g, least);
    ceres_problem.SetParameterUpperBound(solution.factors.data(), g, most);
  }
  const int iterations = nearby ? 20 : 60;
  const Job quiet{.stop = job.stop};
  CeresJob monitor{quiet, "solving muscle lengths", iterations};
  ceres::Solver::Options options = solverOptions(monitor, iterations);
  options.function_tolerance = nearby ? 1e-5 : 1e-8;
  options.parameter_tolerance = nearby ? 1e-5 : 1e-7;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  solution.outcome = outcomeOf(summary);
  solution.cost = summary.final_cost;
  const bool finite = std::ranges::all_of(solution.factors, [](double f) { return std::isfinite(f); });
  // Out of iterations is a point that is better than the start: kept, and said by the caller.
  if (solution.outcome == Outcome::Cancelled || !summary.IsSolutionUsable() || !finite) solution.factors.clear();
  return solution;
}

}  // namespace sinew
