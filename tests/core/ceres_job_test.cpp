#include "core/ceres_job_internal.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace sinew {
namespace {

/// residual = exp(x) - 2, made slow on demand: stands for a long computation.
struct SlowResidual {
  std::chrono::milliseconds delay{0};
  template <class T>
  bool operator()(const T* x, T* residual) const {
    std::this_thread::sleep_for(delay);
    residual[0] = exp(x[0]) - T(2);
    return true;
  }
};

struct SolveResult {
  Outcome outcome;
  double x;
};
SolveResult solve(const Job& job, std::chrono::milliseconds delay, int max_iterations = 50, double start = 3) {
  SolveResult run{Outcome::NotRun, start};
  ceres::Problem problem;
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<SlowResidual, 1, 1>(new SlowResidual{delay}), nullptr,
                           &run.x);
  CeresJob monitor{job, "solve", max_iterations, 0.2, 0.8};
  const auto options = solverOptions(monitor, max_iterations);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  run.outcome = outcomeOf(summary);
  return run;
}

TEST(CeresJob, ReportsItsShareOfTheProgressAndConverges) {
  std::vector<double> fractions;
  Job job;
  job.report_to = [&](double fraction, std::string_view stage) {
    EXPECT_EQ(stage, "solve");
    fractions.push_back(fraction);
  };
  const SolveResult run = solve(job, std::chrono::milliseconds{0});
  EXPECT_EQ(run.outcome, Outcome::Converged);
  EXPECT_NEAR(run.x, std::log(2.0), 1e-6);
  ASSERT_GE(fractions.size(), 3u);
  EXPECT_DOUBLE_EQ(fractions.front(), 0.2);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_LE(fractions.back(), 0.8);
}

TEST(CeresJob, TooFewIterationsAreNotConvergence) {
  EXPECT_EQ(solve({}, std::chrono::milliseconds{0}, 2, 8).outcome, Outcome::NotConverged);
}

TEST(CeresJob, AStopRequestedBeforeTheStartIsCancelled) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(solve({.report_to = {}, .stop = stop.get_token()}, std::chrono::milliseconds{0}).outcome,
            Outcome::Cancelled);
}

TEST(CeresJob, AStopIsAnsweredWithin200Milliseconds) {
  using Clock = std::chrono::steady_clock;
  std::stop_source stop;
  Clock::time_point asked;
  std::jthread user{[&] {
    std::this_thread::sleep_for(std::chrono::milliseconds{60});
    asked = Clock::now();
    stop.request_stop();
  }};
  const Job job{.report_to = {}, .stop = stop.get_token()};
  const SolveResult run = solve(job, std::chrono::milliseconds{20}, 50, 20.0);
  const auto answered = Clock::now();
  user.join();
  EXPECT_EQ(run.outcome, Outcome::Cancelled);
  EXPECT_LT(answered - asked, std::chrono::milliseconds{200});
}

}  // namespace
}  // namespace sinew
