#include "app/widgets/controls/range_slider.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "app/widgets/controls/theme.h"

namespace sinew {
namespace {
constexpr double kMargin_px = 8, kTrackY_px = 10;
}

RangeSlider::RangeSlider(QWidget* parent) : QAbstractSlider{parent} {
  setOrientation(Qt::Horizontal);
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setCursor(Qt::PointingHandCursor);
  setSingleStep(10);
  setPageStep(100);
}

void RangeSlider::setEnds(const QString& low, const QString& high) {
  low_text_ = low;
  high_text_ = high;
  update();
}

void RangeSlider::setBand(int low, int high) {
  band_low_ = low;
  band_high_ = high;
  update();
}

void RangeSlider::setFree(std::optional<std::pair<int, int>> interval) {
  if (interval == free_) return;
  free_ = interval;
  update();
}

double RangeSlider::xOf(double value) const {
  const double span = std::max(1, maximum() - minimum());
  return kMargin_px +
         (std::clamp(value, double(minimum()), double(maximum())) - minimum()) / span * (width() - 2 * kMargin_px);
}

int RangeSlider::valueAt(double x) const {
  const double t = (x - kMargin_px) / std::max(1.0, width() - 2 * kMargin_px);
  const double value = minimum() + std::clamp(t, 0.0, 1.0) * (maximum() - minimum());
  constexpr double kWhole = 10;  // whole units with the mouse, tenths by typing
  return std::clamp(int(std::lround(value / kWhole) * kWhole), minimum(), maximum());
}

void RangeSlider::paintEvent(QPaintEvent*) {
  QPainter painter{this};
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  const auto bar = [&](double low, double high, double height, const QColor& color) {
    painter.setBrush(color);
    painter.drawRoundedRect(
        QRectF{QPointF{xOf(low), kTrackY_px - height / 2}, QPointF{xOf(high), kTrackY_px + height / 2}}, 2, 2);
  };
  bar(minimum(), maximum(), 4, colour::kBorder);
  if (band_low_ < band_high_) bar(band_low_, band_high_, 12, QColor{0xbf, 0xe3, 0xcc});
  if (free_ && free_->first <= free_->second) bar(free_->first, free_->second, 4, colour::kPrimary);
  if (minimum() < 0 && maximum() > 0) {
    painter.setPen(QPen{colour::kMuted, 1});
    painter.drawLine(QPointF{xOf(0), kTrackY_px - 8}, QPointF{xOf(0), kTrackY_px + 8});
  }
  const bool held = free_ && (value() < free_->first - 1 || value() > free_->second + 1);  // 1: rounding
  painter.setPen(QPen{held ? colour::kDanger : colour::kPrimary, hasFocus() ? 3.5 : 2});
  painter.setBrush(held ? colour::kDangerTint : colour::kSurface);
  painter.drawEllipse(QPointF{xOf(value()), kTrackY_px}, 7, 7);
  QFont small = font();
  small.setPixelSize(11);
  painter.setFont(small);
  painter.setPen(colour::kMuted);
  const QRectF line{kMargin_px, 20, width() - 2 * kMargin_px, 15};
  painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, low_text_);
  painter.drawText(line, Qt::AlignRight | Qt::AlignVCenter, high_text_);
}

void RangeSlider::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  setFocus(Qt::MouseFocusReason);
  setSliderDown(true);
  setValue(valueAt(event->position().x()));
}

void RangeSlider::mouseMoveEvent(QMouseEvent* event) {
  if (isSliderDown()) setValue(valueAt(event->position().x()));
}

void RangeSlider::mouseReleaseEvent(QMouseEvent*) {
  setSliderDown(false);
}

void RangeSlider::wheelEvent(QWheelEvent* event) {
  if (hasFocus())
    QAbstractSlider::wheelEvent(event);
  else
    event->ignore();  // the list it stands in scrolls
}

}  // namespace sinew
