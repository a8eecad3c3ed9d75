#include "app/plot/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/plot/svg_parts.h"

namespace sinew {
namespace {

constexpr double kWidth = 720, kPanelHeight = 240, kLeft = 84, kRight = 24, kTop = 52, kGap = 40, kBottom = 56;
// Dark enough for grey prints.
constexpr std::array kColours = {"#0b5394", "#b45309", "#3f6212", "#7c3aed", "#be123c"};
constexpr std::array kDashes = {"", "7 4", "2 3", "10 3 2 3", "4 2"};

/// Linear map of values to the drawing.
struct Axis {
  double low, high, from, to;
  double operator()(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

Axis axisOver(const std::vector<double>& ticks, double from, double to) {
  return {ticks.front(), ticks.back(), from, to};
}

std::vector<double> ticksOf(const PlotPanel& panel) {
  double low = 1e300, high = -1e300;
  for (const auto& line : panel.lines)
    for (const double y : line.y)
      if (std::isfinite(y)) low = std::min(low, y), high = std::max(high, y);
  return low > high ? std::vector<double>{0, 1} : niceTicks(low, high, 5);
}

std::string polyline(const std::vector<double>& x, const PlotLine& line, const Axis& to_u, const Axis& to_v,
                     std::size_t style) {
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < x.size() && i < line.y.size(); ++i) {
    if (!std::isfinite(line.y[i])) {
      pen_down = false;
      continue;
    }
    path += (pen_down ? "L" : "M") + svgNumber(to_u(x[i])) + " " + svgNumber(to_v(line.y[i])) + " ";
    pen_down = true;
  }
  return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + kColours[style % kColours.size()] +
         "\" stroke-width=\"2\" stroke-dasharray=\"" + kDashes[style % kDashes.size()] + "\"/>\n";
}

std::string panelSvg(const PlotPanel& panel, const std::vector<double>& x, const std::vector<double>& x_ticks,
                     double top) {
  const double bottom = top + kPanelHeight;
  const auto y_ticks = ticksOf(panel);
  const Axis to_u = axisOver(x_ticks, kLeft, kWidth - kRight), to_v = axisOver(y_ticks, bottom, top);
  std::string svg;
  for (const double y : y_ticks) {
    svg += svgLine(kLeft, to_v(y), kWidth - kRight, to_v(y), std::abs(y) < 1e-12 ? "#666666" : "#dddddd");
    svg += svgText(kLeft - 8, to_v(y) + 4, tickText(y), "text-anchor=\"end\"");
  }
  for (const double tick : x_ticks) svg += svgLine(to_u(tick), top, to_u(tick), bottom, "#dddddd");
  svg += "<text transform=\"translate(20 " + svgNumber((top + bottom) / 2) +
         ") rotate(-90)\" text-anchor=\"middle\">" + svgEscaped(panel.y_label) + "</text>\n";
  for (std::size_t i = 0; i < panel.lines.size(); ++i) {
    svg += polyline(x, panel.lines[i], to_u, to_v, i);
    if (panel.lines.size() < 2) continue;
    const double u = kLeft + 12 +
                     std::min(190.0, (kWidth - kLeft - kRight) / static_cast<double>(panel.lines.size())) *
                         static_cast<double>(i),
                 v = top - 8;
    svg += "<line x1=\"" + svgNumber(u) + "\" y1=\"" + svgNumber(v - 4) + "\" x2=\"" + svgNumber(u + 28) +
           "\" y2=\"" + svgNumber(v - 4) + "\" stroke=\"" + kColours[i % kColours.size()] +
           "\" stroke-width=\"2\" stroke-dasharray=\"" + kDashes[i % kDashes.size()] + "\"/>\n" +
           svgText(u + 34, v, panel.lines[i].label);
  }
  return svg;
}

}  // namespace

std::vector<double> niceTicks(double low, double high, int count) {
  if (!(high > low)) low -= 0.5, high += 0.5;
  const double raw = (high - low) / std::max(count - 1, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= raw * (1 - 1e-9)) step = factor * power;
  std::vector<double> ticks;
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  for (double i = first; i <= last; ++i) ticks.push_back(i * step);
  return ticks;
}

std::string plotSvg(const std::string& title, const std::string& x_label, const std::vector<double>& x,
                    const std::vector<PlotPanel>& panels) {
  const double height = kTop + static_cast<double>(panels.size()) * (kPanelHeight + kGap) - kGap + kBottom;
  const auto [low, high] = std::ranges::minmax(x);
  const auto x_ticks = niceTicks(low, high, 7);
  std::string svg = svgStart(kWidth, height) + svgText(kLeft, 22, title, "font-size=\"15\" font-weight=\"bold\"");
  double top = kTop;
  for (const auto& panel : panels) {
    svg += panelSvg(panel, x, x_ticks, top);
    top += kPanelHeight + kGap;
  }
  const Axis to_u = axisOver(x_ticks, kLeft, kWidth - kRight);
  for (const double tick : x_ticks)
    svg += svgText(to_u(tick), top - kGap + 18, tickText(tick), "text-anchor=\"middle\"");
  svg += svgText((kLeft + kWidth - kRight) / 2, top - kGap + 40, x_label, "text-anchor=\"middle\"");
  return svg + "</svg>\n";
}

}  // namespace sinew
