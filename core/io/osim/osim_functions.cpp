#include <algorithm>

#include "core/io/osim/osim_reader_internal.h"

namespace sinew {
namespace {

bool isFunction(const XmlElement& element) {
  const std::string tag = element.tag();
  return tag.ends_with("Function") || tag.ends_with("Spline") || tag == "Constant" || tag == "Sine";
}

bool isSpline(const std::string& tag) {
  return tag == "SimmSpline" || tag == "NaturalCubicSpline" || tag == "natCubicSpline" || tag == "GCVSpline" ||
         tag == "PiecewiseLinearFunction";
}

}  // namespace

CoordinateFunction OsimReader::function(const XmlElement& holder, const std::vector<int>& coordinates) {
  const XmlElement inside = holder.find("function").value_or(holder);
  for (const auto& child : inside.children())
    if (isFunction(child)) return functionElement(child, coordinates);
  if (coordinates.empty()) return {};
  if (coordinates.size() == 1) return CoordinateFunction::of(coordinates[0], ScalarFunction::line(1));
  inside.fail("a function", "none");
}

CoordinateFunction OsimReader::functionElement(const XmlElement& element, const std::vector<int>& coordinates,
                                               int depth) {
  constexpr int kDeepest = 20;
  const std::string tag = element.tag();
  if (tag == "Constant") return {element["value"].number(), {}};
  if (tag == "MultiplierFunction") {
    if (depth > kDeepest) element.fail("fewer functions inside functions", "more than " + std::to_string(kDeepest));
    const double scale = element["scale"].number();
    for (const auto& child : element["function"].children())
      if (isFunction(child)) {
        CoordinateFunction inner = functionElement(child, coordinates, depth + 1);
        inner.constant *= scale;
        for (auto& term : inner.terms) term.function = term.function.times(scale);
        return inner;
      }
    element.fail("a function to multiply", "none");
  }
  if (tag != "LinearFunction" && tag != "PolynomialFunction" && !isSpline(tag)) {
    warn("osim_function", "the function <" + tag + "> at " + element.path() + " is not known; 0 stands in");
    return {};
  }
  if (coordinates.empty()) element.fail("a <Constant>, because no coordinate is named", "<" + tag + ">");
  if (tag == "LinearFunction") {
    const auto c = element["coefficients"].numbers(coordinates.size() + 1);
    CoordinateFunction sum{c.back(), {}};
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      sum.terms.push_back({coordinates[i], ScalarFunction::line(c[i])});
    return sum;
  }
  if (coordinates.size() != 1)
    element.fail("a function of one coordinate, or a <LinearFunction>",
                 "<" + tag + "> of " + std::to_string(coordinates.size()) + " coordinates");
  if (tag == "PolynomialFunction") {
    const auto c = element["coefficients"].numbers();
    if (c.empty()) element["coefficients"].fail("coefficients", "none");
    return CoordinateFunction::of(coordinates[0], ScalarFunction::polynomial(c));
  }
  return CoordinateFunction::of(coordinates[0], splineElement(element));
}

ScalarFunction OsimReader::splineElement(const XmlElement& element) {
  const std::string tag = element.tag();
  const auto x = element["x"].numbers();
  const auto y = element["y"].numbers(x.size());
  if (x.empty()) element["x"].fail("knots", "none");
  if (std::ranges::adjacent_find(x, std::greater_equal{}) != x.end())
    element["x"].fail("knots that increase", "a knot that does not");
  if (tag == "GCVSpline") warn("osim_spline", "GCVSpline at " + element.path() + " is read as a SimmSpline");
  return tag == "PiecewiseLinearFunction" ? ScalarFunction::piecewiseLinear(x, y) : ScalarFunction::simmSpline(x, y);
}

}  // namespace sinew
