#include "app/widgets/controls/range_bar.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "app/model/stage_text.h"
#include "app/widgets/controls/theme.h"
#include "core/figure.h"

namespace sinew {
namespace {

constexpr double kMargin_px = 16, kBarY_px = 30, kBarHeight_px = 16, kBeforeY_px = 14, kReachedY_px = 46,
                 kAxisY_px = 60, kGrip_px = 9, kLeastWidth_deg = 2;

}  // namespace

RangeBar::RangeBar(const QString& object_name, QWidget* parent) : QWidget{parent} {
  setObjectName(object_name);
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setMouseTracking(true);
}

void RangeBar::setScale(double low_deg, double high_deg) {
  low_deg_ = low_deg;
  high_deg_ = std::max(low_deg + 1, high_deg);
  update();
}

void RangeBar::setBefore(const Range& range) {
  before_ = range;
  update();
}

void RangeBar::setReached(const Range* range) {
  has_reached_ = range != nullptr;
  if (range) reached_ = *range;
  update();
}

void RangeBar::setRange(const Range& range) {
  if (held_ != Grip::None) return;  // the hand knows better
  range_ = range;
  update();
}

double RangeBar::xOf(double deg) const {
  return kMargin_px +
         (std::clamp(deg, low_deg_, high_deg_) - low_deg_) / (high_deg_ - low_deg_) * (width() - 2 * kMargin_px);
}

double RangeBar::degAt(double x) const {
  return low_deg_ + (x - kMargin_px) / std::max(1.0, width() - 2 * kMargin_px) * (high_deg_ - low_deg_);
}

RangeBar::Grip RangeBar::gripAt(double x) const {
  const double to_low = std::abs(x - xOf(range_.low_deg)), to_high = std::abs(x - xOf(range_.high_deg));
  if (std::min(to_low, to_high) <= kGrip_px) return to_low < to_high ? Grip::Low : Grip::High;
  return x > xOf(range_.low_deg) && x < xOf(range_.high_deg) ? Grip::Both : Grip::None;
}

void RangeBar::move(Grip grip, double by_deg) {
  Range next = pressed_;
  if (grip == Grip::Both) by_deg = std::clamp(by_deg, low_deg_ - next.low_deg, high_deg_ - next.high_deg);
  if (grip != Grip::High) next.low_deg += by_deg;
  if (grip != Grip::Low) next.high_deg += by_deg;
  if (grip == Grip::Low) next.low_deg = std::clamp(next.low_deg, low_deg_, next.high_deg - kLeastWidth_deg);
  if (grip == Grip::High) next.high_deg = std::clamp(next.high_deg, next.low_deg + kLeastWidth_deg, high_deg_);
  range_ = next;
  update();
}

void RangeBar::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  setFocus(Qt::MouseFocusReason);
  held_ = gripAt(event->position().x());
  if (held_ == Grip::Low || held_ == Grip::High) key_grip_ = held_;
  pressed_ = range_;
  press_deg_ = degAt(event->position().x());
}

void RangeBar::mouseMoveEvent(QMouseEvent* event) {
  if (held_ == Grip::None) {
    const Grip under = gripAt(event->position().x());
    setCursor(under == Grip::None ? Qt::ArrowCursor : under == Grip::Both ? Qt::SizeAllCursor : Qt::SizeHorCursor);
    return;
  }
  move(held_, std::round(degAt(event->position().x()) - press_deg_));
  emit dragged(range_.low_deg, range_.high_deg);
}

void RangeBar::mouseReleaseEvent(QMouseEvent*) {
  if (held_ == Grip::None) return;
  held_ = Grip::None;
  emit settled(range_.low_deg, range_.high_deg);
}

void RangeBar::keyPressEvent(QKeyEvent* event) {
  const double step_deg = event->modifiers().testFlag(Qt::ShiftModifier) ? 10 : 1;
  switch (event->key()) {
    case Qt::Key_Up:
      key_grip_ = Grip::High;
      return update();
    case Qt::Key_Down:
      key_grip_ = Grip::Low;
      return update();
    case Qt::Key_Left:
    case Qt::Key_Right:
      pressed_ = range_;
      move(key_grip_, event->key() == Qt::Key_Left ? -step_deg : step_deg);
      emit settled(range_.low_deg, range_.high_deg);
      return;
    default:
      QWidget::keyPressEvent(event);
  }
}

void RangeBar::paintEvent(QPaintEvent*) {
  QPainter painter{this};
  painter.setRenderHint(QPainter::Antialiasing);
  QFont small = font();
  small.setPixelSize(11);
  painter.setFont(small);
  // the axis
  const double span_deg = high_deg_ - low_deg_,
               step_deg = std::max(5.0, roundStep(span_deg, std::max(3, width() / 60)));
  painter.setPen(QPen{colour::kLine, 1});
  painter.drawLine(QPointF{kMargin_px, kAxisY_px}, QPointF{width() - kMargin_px, kAxisY_px});
  for (double deg = std::ceil(low_deg_ / step_deg) * step_deg; deg <= high_deg_ + 1e-9; deg += step_deg) {
    painter.setPen(QPen{colour::kLine, 1});
    painter.drawLine(QPointF{xOf(deg), 8}, QPointF{xOf(deg), kAxisY_px + 3});
    painter.setPen(colour::kMuted);
    painter.drawText(QRectF{xOf(deg) - 24, kAxisY_px + 5, 48, 16}, Qt::AlignCenter,
                     figure(deg, 0) + QStringLiteral("°"));
  }
  const auto line = [&](const Range& range, double y, const QColor& color) {
    painter.setPen(QPen{color, 3, Qt::SolidLine, Qt::FlatCap});
    painter.drawLine(QPointF{xOf(range.low_deg), y}, QPointF{xOf(range.high_deg), y});
  };
  line(before_, kBeforeY_px, colour::kMuted);
  if (has_reached_) line(reached_, kReachedY_px, colour::kPrimary);
  // what is wanted, with its grips
  const QColor wanted{0x00, 0x80, 0x5d};
  const QRectF bar{QPointF{xOf(range_.low_deg), kBarY_px - kBarHeight_px / 2},
                   QPointF{xOf(range_.high_deg), kBarY_px + kBarHeight_px / 2}};
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor{0xbf, 0xe3, 0xcc});
  painter.drawRoundedRect(bar, 3, 3);
  for (const Grip grip : {Grip::Low, Grip::High}) {
    const double deg = grip == Grip::Low ? range_.low_deg : range_.high_deg;
    painter.setPen(QPen{wanted, hasFocus() && grip == key_grip_ ? 3.5 : 2});
    painter.setBrush(colour::kSurface);
    painter.drawEllipse(QPointF{xOf(deg), kBarY_px}, 8, 8);
  }
  painter.setPen(colour::kText);
  if (bar.width() > 110)
    painter.drawText(bar, Qt::AlignCenter,
                     QStringLiteral("%1° … %2°").arg(figure(range_.low_deg, 0), figure(range_.high_deg, 0)));
}

}  // namespace sinew
