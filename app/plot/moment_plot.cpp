#include "app/plot/moment_plot.h"

#include <cmath>

#include "app/plot/paint_figure.h"

namespace sinew {
namespace {

Figure figureOf(const PassiveMomentPlot& plot) {
  FigurePanel panel{"moment, N m"};
  if (!plot.before.empty()) panel.curves.push_back({{}, plot.before, LineRole::Before});
  panel.curves.push_back({{}, plot.after, LineRole::First});
  panel.marks.push_back({{}, plot.threshold_Nm, LineRole::Alarm, true});
  if (std::isfinite(plot.measured_deg)) panel.marks.push_back({{}, plot.measured_deg, LineRole::Measured});
  if (std::isfinite(plot.simulated_after_deg))
    panel.dots.push_back({plot.simulated_after_deg, plot.threshold_Nm, LineRole::First});
  if (std::isfinite(plot.norm_low_deg) && std::isfinite(plot.norm_high_deg))
    panel.band = {plot.norm_low_deg, plot.norm_high_deg, {}};
  panel.from_zero = true;
  panel.highest = 1.5 * plot.threshold_Nm;
  return {plot.title, "angle, deg (" + plot.convention + ")", {std::move(panel)}};
}

}  // namespace

void drawMomentPlot(Ink& ink, const QRectF& box_mm, const PassiveMomentPlot& plot) {
  constexpr double kLetters_mm = 1.9;
  ink.figure(box_mm, figureOf(plot), kLetters_mm);
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
  const auto sample = [&](LineRole role, Qt::PenStyle style) {
    ink.line({x, y}, {x + 7, y}, 0.35, colourOf(role), style);
  };
  sample(LineRole::Before, Qt::DashLine), label("before");
  sample(LineRole::First, Qt::SolidLine), label("after the lengths were fitted");
  sample(LineRole::Alarm, Qt::DotLine), label("examiner stops");
  sample(LineRole::Measured, Qt::DotLine), label("measured");
  ink.disc({x + 3.5, y}, 0.9, colourOf(LineRole::First), true), label("model");
  ink.fill({x, y - 1.2, 7, 2.4}, bandColour().darker(108)), label("norm +-2 SD");
}

}  // namespace sinew
