#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Value of a function and its derivative at one place.
struct FunctionValue {
  double value = 0;
  double slope = 0;
};

/// y = f(x) as other programs write joints, couplings and moving points. Lengths in metres, angles in radians.
///
/// - Constant: coefficients {c}
/// - Polynomial: coefficients from the highest power down (a line is {slope, offset})
/// - PiecewiseLinear, SimmSpline: knots x (strictly increasing) and y. Beyond its ends either goes on straight.
///
/// A SimmSpline is OpenSim's: a C2 cubic through the knots whose third derivative at either end is that of the cubic
/// through the four outermost knots (Forsythe, Malcolm, Moler 1977, SPLINE); with three knots a parabola, with two a
/// line.
class ScalarFunction {
 public:
  enum class Kind { Constant, Polynomial, PiecewiseLinear, SimmSpline };

  ScalarFunction() = default;  ///< 0 everywhere
  static ScalarFunction constant(double value) { return {Kind::Constant, {value}}; }
  static ScalarFunction line(double slope, double offset = 0) { return {Kind::Polynomial, {slope, offset}}; }
  /// @pre not empty
  static ScalarFunction polynomial(std::vector<double> coefficients);
  /// @pre as many y as x, at least one, x strictly increasing
  static ScalarFunction piecewiseLinear(std::vector<double> x, std::vector<double> y);
  static ScalarFunction simmSpline(std::vector<double> x, std::vector<double> y);

  FunctionValue operator()(double x) const;
  ScalarFunction times(double factor) const;

  Kind kind() const { return kind_; }
  const std::vector<double>& coefficients() const { return coefficients_; }
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }

 private:
  ScalarFunction(Kind kind, std::vector<double> coefficients) : kind_{kind}, coefficients_{std::move(coefficients)} {}
  void computeSpline();
  FunctionValue betweenKnots(double x) const;

  Kind kind_ = Kind::Constant;
  std::vector<double> coefficients_{0};
  std::vector<double> x_, y_;
  std::vector<double> b_, c_, d_;  ///< in interval i: y + b t + c t^2 + d t^3, t = x - x_i; b also at the last knot
};

}  // namespace sinew
