#include "core/optimization/bounded_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <random>

#include "core/error.h"

namespace sinew {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kKkt = 1e-9;  // ten times the solver's own tolerance

VectorXd vector(std::initializer_list<double> values) {
  VectorXd v(static_cast<Eigen::Index>(values.size()));
  std::ranges::copy(values, v.begin());
  return v;
}

BoundedLeastSquaresResult solved(const MatrixXd& A, const VectorXd& b, const VectorXd& lower, const VectorXd& upper,
                                 const BoundedLeastSquaresOptions& options = {}, const VectorXd& start = {}) {
  auto result = solveBoundedLeastSquares(A, b, lower, upper, options, start);
  EXPECT_EQ(result.outcome, Outcome::Converged);
  EXPECT_LE(result.kkt_violation, kKkt);
  EXPECT_LE((result.residual - (b - A * result.x)).norm(), 1e-12);
  return result;
}

double objective(const MatrixXd& A, const VectorXd& b, double w, const VectorXd& x) {
  return (b - A * x).squaredNorm() + w * x.squaredNorm();
}

class RandomProblem {
 public:
  explicit RandomProblem(unsigned seed) : random_{seed} {}
  MatrixXd matrix(int rows, int columns, double density = 1) {
    return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform() < density ? normal() : 0.0; });
  }
  VectorXd vectorOf(int size) {
    return VectorXd::NullaryExpr(size, [&] { return normal(); });
  }
  double normal() { return std::normal_distribution<double>{}(random_); }
  double uniform() { return std::generate_canonical<double, 53>(random_); }

 private:
  std::mt19937_64 random_;
};

/// The optimum by trying every assignment of variables to lower bound, upper bound and between.
double bestByExhaustion(const MatrixXd& A, const VectorXd& b, const VectorXd& lower, const VectorXd& upper,
                        double w) {
  const int n = static_cast<int>(A.cols());
  int combinations = 1;
  for (int i = 0; i < n; ++i) combinations *= 3;
  double best = kInfinity;
  for (int code = 0; code < combinations; ++code) {
    VectorXd x(n);
    std::vector<Eigen::Index> free;
    for (int i = 0, rest = code; i < n; ++i, rest /= 3) {
      x[i] = rest % 3 == 0 ? lower[i] : rest % 3 == 1 ? upper[i] : 0;
      if (rest % 3 == 2) free.push_back(i);
    }
    if (!x.allFinite()) continue;  // at an infinite bound
    if (!free.empty()) {
      const MatrixXd F = A(Eigen::all, free);
      MatrixXd gram = F.transpose() * F;
      gram.diagonal().array() += w;
      x(free) = gram.ldlt().solve(F.transpose() * (b - A * x)).eval();
    }
    if ((x.array() < lower.array() - 1e-12).any() || (x.array() > upper.array() + 1e-12).any()) continue;
    best = std::min(best, objective(A, b, w, x));
  }
  return best;
}

TEST(BoundedLeastSquares, WithoutActiveBoundsIsOrdinaryLeastSquares) {
  RandomProblem draw{1};
  const MatrixXd A = draw.matrix(8, 5);
  const VectorXd b = draw.vectorOf(8), wide = VectorXd::Constant(5, 1e3);
  const auto result = solved(A, b, -wide, wide);
  EXPECT_TRUE(result.x.isApprox(A.colPivHouseholderQr().solve(b), 1e-10));
}

TEST(BoundedLeastSquares, ClampsWhereColumnsAreOrthogonal) {
  const MatrixXd A = MatrixXd::Identity(4, 4) * 2;
  const auto result = solved(A, vector({-3, 1, 5, 0}), VectorXd::Zero(4), VectorXd::Ones(4));
  EXPECT_TRUE(result.x.isApprox(vector({0, 0.5, 1, 0})));
}

TEST(BoundedLeastSquares, SolvesByHandWhereTheClampedPointIsNotTheOptimum) {
  // min (x + y - 2)^2 + (x - y - 2)^2: free optimum (2, 0); with x <= 1 the optimum is (1, 0): d/dy vanishes there.
  MatrixXd A(2, 2);
  A << 1, 1, 1, -1;
  EXPECT_TRUE(solved(A, vector({2, 2}), vector({-1, -1}), vector({1, 1})).x.isApprox(vector({1, 0})));
  // Columns (1, 0), (1, 1); b = (0, 1): free optimum (-1, 1); with x >= 0 projecting b on (1, 1) gives y = 1/2.
  A << 1, 1, 0, 1;
  EXPECT_TRUE(
      solved(A, vector({0, 1}), VectorXd::Zero(2), VectorXd::Constant(2, kInfinity)).x.isApprox(vector({0, 0.5})));
}

TEST(BoundedLeastSquares, IsTheBestOfAllActiveSets) {
  RandomProblem draw{2};
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 2 + trial % 4, m = 1 + trial % 6;
    const double w = trial % 3 == 0 || m < n ? 0.01 : 0;  // unique in either case
    const MatrixXd A = draw.matrix(m, n);
    const VectorXd b = 2 * draw.vectorOf(m);
    VectorXd lower = -draw.vectorOf(n).cwiseAbs(), upper = draw.vectorOf(n).cwiseAbs();
    if (trial % 5 == 0) upper.setConstant(kInfinity);
    if (trial % 7 == 0) lower[0] = -kInfinity;
    const auto result = solved(A, b, lower, upper, {.regularization = w});
    EXPECT_NEAR(objective(A, b, w, result.x), bestByExhaustion(A, b, lower, upper, w), 1e-9) << trial;
  }
}

TEST(BoundedLeastSquares, MeetsTheKktConditionsOnProblemsOfEveryShape) {
  RandomProblem draw{3};
  for (int trial = 0; trial < 120; ++trial) {
    const int n = 1 + static_cast<int>(draw.uniform() * 120), m = 1 + static_cast<int>(draw.uniform() * 50);
    const double w = trial % 2 == 0 ? 0 : std::pow(10, -6 * draw.uniform());
    const MatrixXd A = draw.matrix(m, n, trial % 3 == 0 ? 0.1 : 1) * std::pow(10, 4 * draw.uniform() - 2);
    const VectorXd b = draw.vectorOf(m);
    const VectorXd zero = VectorXd::Zero(n);
    solved(A, b, zero, trial % 4 == 0 ? VectorXd::Constant(n, kInfinity) : VectorXd::Ones(n), {.regularization = w});
  }
}

TEST(BoundedLeastSquares, SolvesAFrameOfMuscleCoordinationColdAndWarm) {
  RandomProblem draw{4};  // as many units and coordinates as the reference has; an eighth of the entries
  const MatrixXd A = draw.matrix(50, 282, 0.12);
  const VectorXd b = 3 * draw.vectorOf(50), zero = VectorXd::Zero(282), one = VectorXd::Ones(282);
  const BoundedLeastSquaresOptions options{.regularization = 1e-3};
  const auto cold = solved(A, b, zero, one, options);
  const auto warm = solved(A, 1.01 * b, zero, one, options, cold.x);
  const auto again = solved(A, 1.01 * b, zero, one, options);
  EXPECT_LT(warm.iterations, again.iterations / 4);
  EXPECT_TRUE(warm.x.isApprox(again.x, 1e-8));
}

TEST(BoundedLeastSquares, TakesDegenerateProblems) {
  const VectorXd zero = VectorXd::Zero(3), one = VectorXd::Ones(3);
  MatrixXd A = MatrixXd::Zero(2, 3);
  EXPECT_NEAR(solved(A, vector({1, 1}), zero, one).residual.norm(), std::sqrt(2.0), 1e-15);  // nothing acts
  A << 1, 1, 0, 2, 2, 0;                                                                     // twice the same column
  EXPECT_NEAR(solved(A, vector({0.5, 1}), zero, one).residual.norm(), 0, 1e-12);
  EXPECT_NEAR(solved(A, vector({3, 6}), zero, one).residual.norm(), std::sqrt(5.0), 1e-12);  // both full, not enough
  EXPECT_EQ(solved(A, vector({1, 2}), vector({0.25, 0, 0}), vector({0.25, 1, 1})).x[0], 0.25);  // fixed
  EXPECT_EQ(solved(A, zero.head(2), zero, one).x.norm(), 0);                                    // nothing wanted
  EXPECT_EQ(solveBoundedLeastSquares(MatrixXd(2, 0), vector({1, 1}), {}, {}).residual.size(), 2);
}

TEST(BoundedLeastSquares, SaysWhenItRanOut) {
  RandomProblem draw{5};
  const auto result = solveBoundedLeastSquares(draw.matrix(10, 20), draw.vectorOf(10), VectorXd::Zero(20),
                                               VectorXd::Ones(20), {.max_iterations = 2});
  EXPECT_EQ(result.outcome, Outcome::NotConverged);
  EXPECT_TRUE(result.x.array().isNaN().all());
}

TEST(BoundedLeastSquares, RefusesWhatIsNoProblem) {
  const MatrixXd A = MatrixXd::Identity(2, 2);
  const VectorXd b = VectorXd::Ones(2), zero = VectorXd::Zero(2);
  EXPECT_THROW(solveBoundedLeastSquares(A, VectorXd::Ones(3), zero, b), std::logic_error);
  EXPECT_THROW(solveBoundedLeastSquares(A, b, b, zero), std::logic_error);
  EXPECT_THROW(solveBoundedLeastSquares(A, b * std::nan(""), zero, b), std::logic_error);
  EXPECT_THROW(solveBoundedLeastSquares(A, b, zero, b, {.regularization = -1}), std::logic_error);
}

TEST(KktViolation, MeasuresHowFarAPointIsFromTheOptimum) {
  const MatrixXd A = MatrixXd::Identity(2, 2);
  const VectorXd b = vector({0.5, 2}), zero = VectorXd::Zero(2), one = VectorXd::Ones(2);
  EXPECT_NEAR(kktViolation(A, b, zero, one, 0, vector({0.5, 1})), 0, 1e-15);
  EXPECT_GT(kktViolation(A, b, zero, one, 0, vector({0.5, 0})), 0.5);    // could rise
  EXPECT_GT(kktViolation(A, b, zero, one, 0, vector({0.9, 1})), 0.1);    // not stationary
  EXPECT_GT(kktViolation(A, b, zero, one, 0, vector({0.5, 1.5})), 0.4);  // out of bounds
}

}  // namespace
}  // namespace sinew
