#include "app/widgets/controls/curve_plot.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "app/model/stage_text.h"
#include "app/widgets/controls/theme.h"

namespace sinew {

double roundStep(double span, int most) {
  if (!(span > 0) || most < 1) return 1;
  const double raw = span / most;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double digit : {1., 2., 5.})
    if (digit * power >= raw * (1 - 1e-9)) return digit * power;
  return 10 * power;
}

namespace {
constexpr double kRoom = 0.04;  // of the height, above and below the curves
}

CurvePlot::CurvePlot(QWidget* parent) : QWidget{parent} {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void CurvePlot::setAxes(const QString& x_title, const QString& y_title) {
  x_title_ = x_title;
  y_title_ = y_title;
  update();
}

void CurvePlot::setBand(double low, double high, const QString& name) {
  band_low_ = low;
  band_high_ = high;
  band_name_ = name;
  update();
}

void CurvePlot::setCurves(std::vector<PlotCurve> curves, std::vector<PlotMark> marks, const QString& placeholder) {
  curves_ = std::move(curves);
  marks_ = std::move(marks);
  placeholder_ = placeholder;
  update();
}

CurvePlot::Range CurvePlot::rangeX() const {
  Range range{INFINITY, -INFINITY};
  const auto take = [&](double x) {
    if (!std::isfinite(x)) return;
    range.low = std::min(range.low, x);
    range.high = std::max(range.high, x);
  };
  for (const auto& curve : curves_)
    for (const auto& [x, y] : curve.points) take(x);
  for (const auto& mark : marks_)
    if (!mark.horizontal) take(mark.value);
  if (!(range.low < range.high)) range = {range.low - 1, range.low + 1};
  return range;
}

CurvePlot::Range CurvePlot::rangeY() const {
  Range range = from_zero_ ? Range{0, 0} : Range{INFINITY, -INFINITY};
  for (const auto& curve : curves_)
    for (const auto& [x, y] : curve.points)
      if (std::isfinite(y)) range = {std::min(range.low, y), std::max(range.high, y)};
  for (const auto& mark : marks_)
    if (mark.horizontal)  // with room for its name above
      range.high = std::max(range.high, from_zero_ ? mark.value * 1.15 : mark.value + 0.3 * (mark.value - range.low));
  if (const double room = kRoom * (range.high - range.low); room > 0 && std::isfinite(room)) {  // no line on the edge
    if (range.low != 0) range.low -= room;
    if (range.high != 0) range.high += room;
  }
  if (highest_ > 0) range = {std::max(range.low, -highest_ / 4), std::min(range.high, highest_)};
  if (!(range.low < range.high)) range = {0, 1};
  return range;
}

void CurvePlot::paintEvent(QPaintEvent*) {
  QPainter painter{this};
  painter.setRenderHint(QPainter::Antialiasing);
  QFont small = font();
  small.setPixelSize(11);
  painter.setFont(small);
  if (curves_.empty()) {
    painter.setPen(colour::kMuted);
    painter.drawText(rect().adjusted(16, 16, -16, -16), Qt::AlignCenter | Qt::TextWordWrap, placeholder_);
    return;
  }
  const QRectF area = QRectF{rect()}.adjusted(48, 42, -14, -38);
  const Range x = rangeX(), y = rangeY();
  const auto toX = [&](double value) { return area.left() + (value - x.low) / (x.high - x.low) * area.width(); };
  const auto toY = [&](double value) { return area.bottom() - (value - y.low) / (y.high - y.low) * area.height(); };

  if (band_low_ < band_high_) {
    const double from = std::clamp(toX(band_low_), area.left(), area.right());
    const double to = std::clamp(toX(band_high_), area.left(), area.right());
    painter.fillRect(QRectF{std::min(from, to), area.top(), std::abs(to - from), area.height()},
                     colour::kSuccessTint);
  }
  const double step_x = roundStep(x.high - x.low, std::max(2, int(area.width() / 48)));
  const double step_y = roundStep(y.high - y.low, std::max(2, int(area.height() / 22)));
  for (double t = std::ceil(x.low / step_x) * step_x; t <= x.high + 1e-9; t += step_x) {
    painter.setPen(QPen{colour::kLine, 1});
    painter.drawLine(QPointF{toX(t), area.top()}, QPointF{toX(t), area.bottom()});
    painter.setPen(colour::kMuted);
    painter.drawText(QRectF{toX(t) - 30, area.bottom() + 3, 60, 16}, Qt::AlignCenter, figure(t, step_x < 1 ? 1 : 0));
  }
  for (double t = std::ceil(y.low / step_y) * step_y; t <= y.high + 1e-9; t += step_y) {
    painter.setPen(QPen{colour::kLine, 1});
    painter.drawLine(QPointF{area.left(), toY(t)}, QPointF{area.right(), toY(t)});
    painter.setPen(colour::kMuted);
    painter.drawText(QRectF{0, toY(t) - 8, area.left() - 6, 16}, Qt::AlignRight | Qt::AlignVCenter,
                     figure(t, step_y < 1 ? 1 : 0));
  }
  painter.drawText(QRectF{area.left(), area.bottom() + 19, area.width(), 16}, Qt::AlignRight, x_title_);
  painter.drawText(QRectF{4, 20, area.width(), 16}, Qt::AlignLeft, y_title_);

  double legend_x = area.right();
  const auto legend = [&](const QString& name, const QPen& pen) {
    if (name.isEmpty()) return;
    const double width = painter.fontMetrics().horizontalAdvance(name);
    legend_x -= width;
    painter.setPen(colour::kText);
    painter.drawText(QPointF{legend_x, 14}, name);
    painter.setPen(pen);
    painter.drawLine(QPointF{legend_x - 24, 10}, QPointF{legend_x - 6, 10});
    legend_x -= 36;
  };
  painter.save();
  painter.setClipRect(area);
  for (const auto& mark : marks_) {
    painter.setPen(QPen{mark.color, 1.4, Qt::DotLine});
    if (mark.horizontal)
      painter.drawLine(QPointF{area.left(), toY(mark.value)}, QPointF{area.right(), toY(mark.value)});
    else
      painter.drawLine(QPointF{toX(mark.value), area.top()}, QPointF{toX(mark.value), area.bottom()});
  }
  for (const auto& curve : curves_) {
    QPolygonF line;
    for (const auto& [px, py] : curve.points)
      if (std::isfinite(py)) line << QPointF{toX(px), toY(py)};
    painter.setPen(QPen{curve.color, 2, curve.dashed ? Qt::DashLine : Qt::SolidLine});
    painter.drawPolyline(line);
  }
  for (const auto& mark : marks_) {
    painter.setPen(mark.color);
    if (mark.horizontal) {
      // At the left, unless a name of a vertical mark is there.
      const bool taken = std::ranges::any_of(
          marks_, [&](const PlotMark& m) { return !m.horizontal && toX(m.value) < area.left() + area.width() / 3; });
      painter.drawText(QRectF{area.left() + 4, toY(mark.value) - 17, area.width() - 8, 14},
                       (taken ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignBottom, mark.name);
    } else {
      const bool near_right = toX(mark.value) > area.center().x();
      const QRectF box{near_right ? toX(mark.value) - 124 : toX(mark.value) + 4, area.top() + 2, 120, 16};
      const auto side = near_right ? Qt::AlignRight : Qt::AlignLeft;
      painter.fillRect(painter.boundingRect(box, side, mark.name), QColor{255, 255, 255, 200});  // curves run below
      painter.drawText(box, side, mark.name);
    }
  }
  painter.restore();
  for (auto curve = curves_.rbegin(); curve != curves_.rend(); ++curve)
    legend(curve->name, QPen{curve->color, 2, curve->dashed ? Qt::DashLine : Qt::SolidLine});
  if (band_low_ < band_high_) {
    const double width = painter.fontMetrics().horizontalAdvance(band_name_);
    legend_x -= width;
    painter.setPen(colour::kText);
    painter.drawText(QPointF{legend_x, 14}, band_name_);
    painter.fillRect(QRectF{legend_x - 22, 5, 16, 10}, colour::kSuccessTint.darker(108));
  }
}

}  // namespace sinew
