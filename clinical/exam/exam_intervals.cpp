#include <algorithm>
#include <cmath>

#include "clinical/exam/exam_problem_internal.h"

namespace sinew {
namespace {

constexpr double k95 = 1.959964;

/// Sums of squares of what one standard deviation of each source does to the factors, to either side: a muscle beside
/// a stiff capsule may be any longer, but not any shorter.
struct Spread {
  std::vector<double> down, up;
  void add(const std::vector<double>& base, const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t g = 0; g < base.size(); ++g) {
      const double x = a[g] - base[g], y = b[g] - base[g];
      down[g] += std::pow(std::max({-x, -y, 0.0}), 2);
      up[g] += std::pow(std::max({x, y, 0.0}), 2);
    }
  }
};

}  // namespace

std::vector<FactorInterval> factorIntervals(const SideProblem& problem, const std::vector<double>& start,
                                            double length_sd_m, const Job& job) {
  const auto& tests = *problem.tests;
  const auto& groups = *problem.groups;
  const SideSolution base = solveSide(problem, start, job);
  if (!base.usable()) return {};
  Spread spread{std::vector<double>(groups.size()), std::vector<double>(groups.size())};
  /// Both disturbed problems; false if one has no solution.
  const auto disturb = [&](const auto& change) {
    SideProblem less = problem, more = problem;
    change(less, -1.0);
    change(more, 1.0);
    const SideSolution a = solveSide(less, base.factors, job, true), b = solveSide(more, base.factors, job, true);
    if (!a.usable() || !b.usable()) return false;
    spread.add(base.factors, a.factors, b.factors);
    return true;
  };
  bool good = true;
  for (std::size_t i = 0; i < tests.size(); ++i)
    good = good && disturb([&](SideProblem& p, double sign) {
             p.places[i] += sign * tests[i].test->form->measurement_sd_deg;
           });
  // The prior counts as a measurement of 1: what the tests leave open, it fills.
  for (std::size_t g = 0; g < groups.size(); ++g)
    good = good && disturb([&](SideProblem& p, double sign) { p.prior_means[g] += sign * kFactorPrior; });
  double band = 0;
  for (const auto& test : tests) band = std::max(band, test.test->threshold_band_share);
  good = good && disturb([&](SideProblem& p, double sign) { p.threshold_scale += sign * band / k95; });
  if (!good) return {};

  std::vector<FactorInterval> intervals;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    // A path longer by d is held alike by muscles longer by d.
    const double bones = std::pow(length_sd_m / groups[g].mean_length_m, 2);
    const double down = std::sqrt(spread.down[g] + bones), up = std::sqrt(spread.up[g] + bones);
    intervals.push_back({.lower = std::clamp(base.factors[g] - k95 * down, kLeastFactor, kMostFactor),
                         .upper = std::clamp(base.factors[g] + k95 * up, kLeastFactor, kMostFactor),
                         .determined = std::max(down, up) < 0.5 * kFactorPrior});
  }
  return intervals;
}

}  // namespace sinew
