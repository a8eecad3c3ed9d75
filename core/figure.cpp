#include "core/figure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace sinew {
namespace {

constexpr FigureRange kNothing{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

void include(FigureRange& range, double value) {
  if (std::isfinite(value)) range = {std::min(range.low, value), std::max(range.high, value)};
}

}  // namespace

FigureCurve curveOver(const std::vector<double>& x, const std::vector<double>& y, std::string name,
                      std::size_t place) {
  require(x.size() == y.size(), "a curve has a y for every x");
  FigureCurve curve{std::move(name), {}, static_cast<LineRole>(place % 5)};
  for (std::size_t i = 0; i < x.size(); ++i) curve.points.emplace_back(x[i], y[i]);
  return curve;
}

double roundStep(double span, int most) {
  if (!(span > 0) || most < 1) return 1;
  const double raw = span / most;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double digit : {1., 2., 5.})
    if (digit * power >= raw * (1 - 1e-9)) return digit * power;
  return 10 * power;
}

FigureRange rangeOfX(const Figure& figure) {
  FigureRange range = kNothing;
  for (const auto& panel : figure.panels) {
    for (const auto& curve : panel.curves)
      for (const auto& [x, y] : curve.points) include(range, x);
    for (const auto& mark : panel.marks)
      if (!mark.horizontal) include(range, mark.value);
  }
  if (!(range.low <= range.high)) return {};
  if (range.low == range.high) return {range.low - 1, range.high + 1};
  return range;
}

FigureRange rangeOfY(const FigurePanel& panel) {
  constexpr double kRoom = 0.04, kRoomForName = 0.15;  // shares of the height
  FigureRange range = panel.from_zero ? FigureRange{0, 0} : kNothing;
  for (const auto& curve : panel.curves)
    for (const auto& [x, y] : curve.points) include(range, y);
  for (const auto& dot : panel.dots) include(range, dot.y);
  if (!(range.low <= range.high)) range = {0, 1};
  for (const auto& mark : panel.marks)
    if (mark.horizontal) {
      include(range, mark.value);
      include(range, mark.value + kRoomForName * (mark.value - range.low));
    }
  const double room = range.high > range.low ? kRoom * (range.high - range.low) : 0.5;
  if (range.low != 0 || room == 0.5) range.low -= room;
  if (range.high != 0 || room == 0.5) range.high += room;
  if (panel.highest > 0) range = {std::max(range.low, -panel.highest / 4), std::min(range.high, panel.highest)};
  return range.low < range.high ? range : FigureRange{0, 1};
}

}  // namespace sinew
