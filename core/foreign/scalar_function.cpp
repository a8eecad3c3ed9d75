#include "core/foreign/scalar_function.h"

#include <algorithm>

#include "core/error.h"

namespace sinew {
namespace {

/// Solves a tridiagonal symmetric system in place; `right` becomes the solution.
void solveTridiagonal(std::vector<double>& diagonal, const std::vector<double>& off, std::vector<double>& right) {
  const std::size_t n = diagonal.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double t = off[i - 1] / diagonal[i - 1];
    diagonal[i] -= t * off[i - 1];
    right[i] -= t * right[i - 1];
  }
  right[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) right[i] = (right[i] - off[i] * right[i + 1]) / diagonal[i];
}

}  // namespace

ScalarFunction ScalarFunction::polynomial(std::vector<double> coefficients) {
  require(!coefficients.empty(), "a polynomial has coefficients");
  return {Kind::Polynomial, std::move(coefficients)};
}

ScalarFunction ScalarFunction::piecewiseLinear(std::vector<double> x, std::vector<double> y) {
  require(!x.empty() && x.size() == y.size(), "knots come in pairs");
  require(std::ranges::adjacent_find(x, std::greater_equal{}) == x.end(), "knots increase");
  ScalarFunction f{Kind::PiecewiseLinear, {}};
  f.x_ = std::move(x);
  f.y_ = std::move(y);
  const std::size_t n = f.x_.size();
  f.b_.assign(n, 0);
  for (std::size_t i = 0; i + 1 < n; ++i) f.b_[i] = (f.y_[i + 1] - f.y_[i]) / (f.x_[i + 1] - f.x_[i]);
  if (n > 1) f.b_[n - 1] = f.b_[n - 2];
  f.c_ = f.d_ = std::vector<double>(n, 0);
  return f;
}

ScalarFunction ScalarFunction::simmSpline(std::vector<double> x, std::vector<double> y) {
  ScalarFunction f = piecewiseLinear(std::move(x), std::move(y));
  f.kind_ = Kind::SimmSpline;
  if (f.x_.size() > 2) f.computeSpline();
  return f;
}

/// Unknowns s_i are a sixth of the second derivatives.
void ScalarFunction::computeSpline() {
  const std::size_t n = x_.size();
  std::vector<double> h(n - 1), chord(n - 1), diagonal(n), s(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h[i] = x_[i + 1] - x_[i];
    chord[i] = (y_[i + 1] - y_[i]) / h[i];
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    diagonal[i] = 2 * (h[i - 1] + h[i]);
    s[i] = chord[i] - chord[i - 1];
  }
  /// Third divided difference of the four knots from i.
  const auto third = [&](std::size_t i) {
    const double left = (chord[i + 1] - chord[i]) / (x_[i + 2] - x_[i]);
    const double right = (chord[i + 2] - chord[i + 1]) / (x_[i + 3] - x_[i + 1]);
    return (right - left) / (x_[i + 3] - x_[i]);
  };
  diagonal[0] = -h[0];
  diagonal[n - 1] = -h[n - 2];
  s[0] = n > 3 ? h[0] * h[0] * third(0) : 0;
  s[n - 1] = n > 3 ? -h[n - 2] * h[n - 2] * third(n - 4) : 0;
  solveTridiagonal(diagonal, h, s);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    b_[i] = chord[i] - h[i] * (s[i + 1] + 2 * s[i]);
    c_[i] = 3 * s[i];
    d_[i] = (s[i + 1] - s[i]) / h[i];
  }
  b_[n - 1] = chord[n - 2] + h[n - 2] * (s[n - 2] + 2 * s[n - 1]);
}

FunctionValue ScalarFunction::betweenKnots(double x) const {
  if (x < x_.front()) return {y_.front() + (x - x_.front()) * b_.front(), b_.front()};
  if (x >= x_.back()) return {y_.back() + (x - x_.back()) * b_.back(), b_.back()};
  const auto i = static_cast<std::size_t>(std::ranges::upper_bound(x_, x) - x_.begin()) - 1;
  const double t = x - x_[i];
  return {y_[i] + t * (b_[i] + t * (c_[i] + t * d_[i])), b_[i] + t * (2 * c_[i] + 3 * t * d_[i])};
}

FunctionValue ScalarFunction::operator()(double x) const {
  if (kind_ == Kind::PiecewiseLinear || kind_ == Kind::SimmSpline) return betweenKnots(x);
  FunctionValue f;
  for (const double c : coefficients_) f = {f.value * x + c, f.slope * x + f.value};
  return f;
}

ScalarFunction ScalarFunction::times(double factor) const {
  ScalarFunction f = *this;
  for (auto* list : {&f.coefficients_, &f.y_, &f.b_, &f.c_, &f.d_})
    for (double& v : *list) v *= factor;
  return f;
}

}  // namespace sinew
