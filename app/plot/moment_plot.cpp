#include "app/plot/moment_plot.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

const QColor kBefore{110, 110, 110}, kAfter{0, 72, 120}, kMeasured{190, 70, 0}, kNorm{228, 232, 226},
    kGrid{205, 205, 205};
constexpr double kTick_mm = 1.9;

/// Angle and moment -> page.
struct Axes {
  QRectF box;
  double x0, x1, y1;
  QPointF at(double angle, double moment) const {
    return {box.left() + (angle - x0) / (x1 - x0) * box.width(), box.bottom() - moment / y1 * box.height()};
  }
  double x(double angle) const { return at(std::clamp(angle, x0, x1), 0).x(); }
};

Axes axesOf(const QRectF& box_mm, const PassiveMomentPlot& plot) {
  Axes axes{box_mm.adjusted(9, 4.2, -2, -7.5), 1e9, -1e9, 1.5 * plot.threshold_Nm};
  for (const auto& [angle, moment] : plot.after) {
    axes.x0 = std::min(axes.x0, angle);
    axes.x1 = std::max(axes.x1, angle);
  }
  if (!(axes.x0 < axes.x1)) axes.x0 = 0, axes.x1 = 1;
  if (!(axes.y1 > 0)) axes.y1 = 1;
  return axes;
}

void drawGrid(Ink& ink, const Axes& axes) {
  const Ink::TextStyle tick{.size_mm = kTick_mm, .align = Qt::AlignHCenter | Qt::AlignTop, .wrap = false};
  auto side = tick;
  side.align = Qt::AlignRight | Qt::AlignVCenter;
  const double dx = roundStep(axes.x1 - axes.x0), dy = roundStep(axes.y1);
  for (double a = std::ceil(axes.x0 / dx) * dx; a <= axes.x1 + 1e-9; a += dx) {
    const double x = axes.x(a);
    ink.line({x, axes.box.top()}, {x, axes.box.bottom()}, 0.06, kGrid);
    ink.text({x - 8, axes.box.bottom() + 0.5, 16, 3}, QString::number(a == 0 ? 0.0 : a), tick);
  }
  for (double m = 0; m <= axes.y1 + 1e-9; m += dy) {
    const double y = axes.at(0, m).y();
    ink.line({axes.box.left(), y}, {axes.box.right(), y}, 0.06, kGrid);
    ink.text({axes.box.left() - 8, y - 1.5, 7.4, 3}, QString::number(m), side);
  }
  ink.frame(axes.box, 0.15, shade::kMuted);
}

void drawCurve(Ink& ink, const Axes& axes, const std::vector<std::pair<double, double>>& curve, const QColor& colour,
               double width_mm, Qt::PenStyle style) {
  std::vector<QPointF> points;
  for (const auto& [angle, moment] : curve)
    if (std::isfinite(moment)) points.push_back(axes.at(angle, std::clamp(moment, -axes.y1, 3 * axes.y1)));
  if (points.size() > 1) ink.polyline(points, width_mm, colour, style);
}

}  // namespace

double roundStep(double range) {
  const double decade = std::pow(10, std::floor(std::log10(std::max(range, 1e-9) / 4)));
  double step = decade;
  for (const double factor : {2.0, 5.0, 10.0})
    if (range / (decade * factor) >= 4) step = decade * factor;
  return step;
}

void drawMomentPlot(Ink& ink, const QRectF& box_mm, const PassiveMomentPlot& plot) {
  const Axes axes = axesOf(box_mm, plot);
  ink.text({box_mm.left(), box_mm.top(), box_mm.width(), 4}, QString::fromStdString(plot.title),
           {.size_mm = 2.3, .bold = true, .wrap = false});
  if (std::isfinite(plot.norm_low_deg) && std::isfinite(plot.norm_high_deg)) {
    const double a = axes.x(plot.norm_low_deg), b = axes.x(plot.norm_high_deg);
    ink.fill({std::min(a, b), axes.box.top(), std::abs(b - a), axes.box.height()}, kNorm);
  }
  drawGrid(ink, axes);
  ink.clipTo(axes.box);
  drawCurve(ink, axes, plot.before, kBefore, 0.25, Qt::DashLine);
  drawCurve(ink, axes, plot.after, kAfter, 0.4, Qt::SolidLine);
  const double stop = axes.at(0, plot.threshold_Nm).y();
  ink.line({axes.box.left(), stop}, {axes.box.right(), stop}, 0.2, Qt::black, Qt::DotLine);
  if (std::isfinite(plot.measured_deg)) {
    const double x = axes.x(plot.measured_deg);
    ink.line({x, axes.box.top()}, {x, axes.box.bottom()}, 0.45, kMeasured);
  }
  ink.unclip();
  if (std::isfinite(plot.simulated_after_deg)) {
    const QPointF p{axes.x(plot.simulated_after_deg), stop};
    ink.disc(p, 0.9, kAfter, true);
  }
  const QString label = "angle, deg (" + QString::fromStdString(plot.convention) + ")";
  Ink::TextStyle style{.size_mm = kTick_mm, .align = Qt::AlignHCenter, .wrap = false};
  style.size_mm *= std::min(1.0, box_mm.width() / Ink::textWidth_mm(label, style));  // long conventions stay whole
  ink.text({box_mm.left(), box_mm.bottom() - 4.2, box_mm.width(), 3}, label, style);
  ink.verticalText({box_mm.left() - 1.2, axes.box.top(), 3, axes.box.height()}, "moment, N m", {.size_mm = kTick_mm});
}

void drawMomentLegend(Ink& ink, const QRectF& box_mm) {
  const double y = box_mm.center().y();
  double x = box_mm.left();
  const auto label = [&](const QString& text) {
    const Ink::TextStyle style{.size_mm = 2.1, .align = Qt::AlignLeft | Qt::AlignVCenter, .wrap = false};
    const double width = Ink::textWidth_mm(text, style);
    ink.text({x + 8, y - 2, width + 2, 4}, text, style);
    x += width + 13;
  };
  const auto sample = [&](double width_mm, const QColor& colour, Qt::PenStyle style) {
    ink.line({x, y}, {x + 7, y}, width_mm, colour, style);
  };
  sample(0.25, kBefore, Qt::DashLine), label("before");
  sample(0.4, kAfter, Qt::SolidLine), label("after the lengths were fitted");
  sample(0.2, Qt::black, Qt::DotLine), label("examiner stops");
  sample(0.45, kMeasured, Qt::SolidLine), label("measured");
  ink.disc({x + 3.5, y}, 0.9, kAfter, true), label("model");
  ink.fill({x, y - 1.2, 7, 2.4}, kNorm), label("norm +-2 SD");
}

}  // namespace sinew
