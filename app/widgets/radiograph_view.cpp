#include "app/widgets/radiograph_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "app/model/image_store.h"
#include "app/model/stage_text.h"
#include "app/widgets/theme.h"

namespace sinew {
namespace {

constexpr double kGrabRadius = 9;  // logical pixels around a mark that take hold of it
constexpr double kClickSlack = 4;  // a press that moves less is a click
constexpr double kMaxZoom = 16;
constexpr double kLoupeRadius = 62, kLoupeZoom = 4;

double clampedWindow(double width) {
  return std::max(2.0, width);
}

}  // namespace

RadiographView::RadiographView(QWidget* parent) : QWidget{parent} {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  placeholder_ = tr("No radiograph");
}

void RadiographView::setRadiograph(std::shared_ptr<const Radiograph> radiograph) {
  if (radiograph == radiograph_) return;
  radiograph_ = std::move(radiograph);
  halves_.clear();
  if (radiograph_)
    for (const Radiograph* r = radiograph_.get(); std::min(r->width_px, r->height_px) >= 256 && halves_.size() < 5;
         r = &halves_.back())
      halves_.push_back(halfSize(*r));
  forgetPictures();
  fit();
}

void RadiographView::forgetPictures() {
  pictures_.assign(radiograph_ ? halves_.size() + 1 : 0, QImage{});
  update();
}

void RadiographView::setPlaceholder(const QString& text) {
  placeholder_ = text;
  update();
}

void RadiographView::setDisplay(const DisplayWindow& display) {
  if (display == display_) return;
  display_ = display;
  forgetPictures();
}

void RadiographView::setMarks(std::vector<MarkOverlay> marks, const std::string& selected) {
  marks_ = std::move(marks);
  selected_ = selected;
  update();
}

void RadiographView::setLines(std::vector<LineOverlay> lines) {
  lines_ = std::move(lines);
  update();
}

void RadiographView::setOrientation(const QString& left_edge, const QString& right_edge) {
  left_edge_ = left_edge;
  right_edge_ = right_edge;
  update();
}

void RadiographView::setTool(Tool tool) {
  tool_ = tool;
  setCursor(tool == Tool::Place ? Qt::CrossCursor : Qt::ArrowCursor);
}

void RadiographView::setLoupe(bool on) {
  loupe_ = on;
  update();
}

double RadiographView::windowCenter() const {
  return display_.center ? *display_.center : radiograph_ ? radiograph_->window_center : 0;
}

double RadiographView::windowWidth() const {
  return clampedWindow(display_.width ? *display_.width : radiograph_ ? radiograph_->window_width : 1);
}

QPointF RadiographView::toImage(const QPointF& widget) const {
  return (widget - QPointF{width() / 2.0, height() / 2.0}) / zoom_ + center_px_;
}

QPointF RadiographView::toWidget(const QPointF& uv_px) const {
  return (uv_px - center_px_) * zoom_ + QPointF{width() / 2.0, height() / 2.0};
}

void RadiographView::fit() {
  fitted_ = true;
  if (radiograph_ && width() > 0 && height() > 0) {
    zoom_ = std::min(double(width()) / radiograph_->width_px, double(height()) / radiograph_->height_px);
    center_px_ = {radiograph_->width_px / 2.0 - 0.5, radiograph_->height_px / 2.0 - 0.5};
  }
  update();
  emit zoomChanged();
}

void RadiographView::oneToOne() {
  setZoomAt(1 / devicePixelRatioF(), {width() / 2.0, height() / 2.0});
}

void RadiographView::zoomTo(const QPointF& uv_px, double zoom) {
  fitted_ = false;
  center_px_ = uv_px;
  zoom_ = std::min(zoom, kMaxZoom);
  update();
  emit zoomChanged();
}

void RadiographView::reveal(const QPointF& uv_px) {
  if (fitted_ || QRectF(rect()).adjusted(30, 30, -30, -30).contains(toWidget(uv_px))) return;
  center_px_ = uv_px;
  update();
}

void RadiographView::setZoomAt(double zoom, const QPointF& widget_point) {
  if (!radiograph_) return;
  const double smallest =
      0.5 * std::min(double(width()) / radiograph_->width_px, double(height()) / radiograph_->height_px);
  const QPointF held = toImage(widget_point);
  zoom_ = std::clamp(zoom, std::min(smallest, 0.5), kMaxZoom);
  fitted_ = false;
  center_px_ += held - toImage(widget_point);
  update();
  emit zoomChanged();
}

const MarkOverlay* RadiographView::markAt(const QPointF& widget_point) const {
  const MarkOverlay* best = nullptr;
  double best_distance = kGrabRadius;
  for (const auto& mark : marks_) {
    if (mark.hollow) continue;
    const QPointF d = toWidget(mark.uv_px) - widget_point;
    double distance = std::hypot(d.x(), d.y());
    if (mark.name == selected_) distance -= 3;  // the selected one wins among close neighbours
    if (distance < best_distance) {
      best = &mark;
      best_distance = distance;
    }
  }
  return best;
}

const QImage& RadiographView::levelImage(int level) {
  QImage& picture = pictures_[std::size_t(level)];
  if (picture.isNull()) {
    const Radiograph& source = level == 0 ? *radiograph_ : halves_[std::size_t(level - 1)];
    const auto grey = displayPixels(source, windowCenter(), windowWidth(), display_.invert);
    picture = QImage{source.width_px, source.height_px, QImage::Format_Grayscale8};
    for (int v = 0; v < source.height_px; ++v)
      std::copy_n(grey.data() + std::size_t(v) * std::size_t(source.width_px), source.width_px, picture.scanLine(v));
  }
  return picture;
}

void RadiographView::paintEvent(QPaintEvent*) {
  QPainter painter{this};
  painter.fillRect(rect(), colour::kView);
  if (!radiograph_) {
    painter.setPen(QColor{0x8d, 0x9d, 0xab});
    painter.drawText(rect().adjusted(24, 24, -24, -24), Qt::AlignCenter | Qt::TextWordWrap, placeholder_);
    return;
  }
  const double device_zoom = zoom_ * devicePixelRatioF();
  const int level = std::clamp(int(std::floor(-std::log2(std::max(device_zoom, 1e-6)))), 0, int(halves_.size()));
  const QImage& picture = levelImage(level);
  const double scale = double(1 << level);
  // Pixel (0, 0) is a centre: the picture's corner lies half a pixel up and left of it.
  const QRectF target{toWidget({-0.5, -0.5}),
                      QSizeF{picture.width() * scale * zoom_, picture.height() * scale * zoom_}};
  painter.setRenderHint(QPainter::SmoothPixmapTransform, device_zoom < 4);
  painter.drawImage(target, picture);

  painter.setRenderHint(QPainter::Antialiasing);
  painter.save();
  painter.setClipRect(target);  // nothing was seen beyond the film
  for (const auto& line : lines_) {
    QPolygonF polygon;
    for (const auto& p : line.points_px) polygon << toWidget(p);
    QPen pen{line.color, line.width};
    if (line.dashed) pen.setDashPattern({5, 4});
    painter.setPen(pen);
    painter.drawPolyline(polygon);
  }
  painter.restore();
  paintMarks(painter);
  paintScaleBar(painter);

  QFont large = font();
  large.setPixelSize(18);
  large.setBold(true);
  painter.setFont(large);
  painter.setPen(colour::kViewText);
  painter.drawText(rect().adjusted(12, 0, -12, 0), Qt::AlignLeft | Qt::AlignVCenter, left_edge_);
  painter.drawText(rect().adjusted(12, 0, -12, 0), Qt::AlignRight | Qt::AlignVCenter, right_edge_);
  if (loupe_ && cursor_ && (tool_ == Tool::Place || drag_ == Drag::Mark)) paintLoupe(painter);
}

void RadiographView::paintMarks(QPainter& painter) const {
  for (const auto& mark : marks_) {
    const bool selected = mark.name == selected_;
    const QPointF p = toWidget(mark.uv_px);
    if (!QRectF(rect()).adjusted(-20, -20, 20, 20).contains(p)) continue;
    const QColor color = selected ? colour::kSelected : mark.color;
    if (mark.projected_px) {
      painter.setPen(QPen{QColor{0xff, 0x6b, 0x5e}, 1.6});
      painter.drawLine(p, toWidget(*mark.projected_px));
    }
    for (const double width : {3.6, 1.6}) {  // a dark rim keeps the mark visible on bright bone
      painter.setPen(QPen{width > 2 ? QColor{0, 0, 0, 150} : color, width});
      painter.setBrush(Qt::NoBrush);
      if (mark.hollow) {
        painter.drawEllipse(p, 5, 5);
      } else {
        const double arm = selected ? 8 : 5;
        painter.drawLine(p - QPointF{arm, 0}, p + QPointF{arm, 0});
        painter.drawLine(p - QPointF{0, arm}, p + QPointF{0, arm});
        if (selected) painter.drawEllipse(p, 11, 11);
      }
    }
    if (selected && drag_ != Drag::Mark) {
      const QString text = readableName(mark.name);
      QFont small = font();
      small.setPixelSize(12);
      painter.setFont(small);
      const QRectF box = painter.fontMetrics().boundingRect(text).adjusted(-6, -3, 6, 3);
      QRectF place{p + QPointF{16, -box.height() / 2}, box.size()};
      if (place.right() > width() - 4) place.moveRight(p.x() - 16);
      painter.setPen(Qt::NoPen);
      painter.setBrush(QColor{10, 15, 20, 205});
      painter.drawRoundedRect(place, 4, 4);
      painter.setPen(colour::kSelected);
      painter.drawText(place, Qt::AlignCenter, text);
    }
  }
}

void RadiographView::paintLoupe(QPainter& painter) {
  const QPointF at = *cursor_;
  QPointF middle = at + QPointF{kLoupeRadius + 26, -kLoupeRadius - 26};
  if (middle.x() + kLoupeRadius > width()) middle.setX(at.x() - kLoupeRadius - 26);
  if (middle.y() - kLoupeRadius < 0) middle.setY(at.y() + kLoupeRadius + 26);
  const double zoom = std::max(zoom_ * kLoupeZoom, 1.0);
  const QPointF center = toImage(at);
  painter.save();
  QPainterPath lens;
  lens.addEllipse(middle, kLoupeRadius, kLoupeRadius);
  painter.setClipPath(lens);
  painter.fillPath(lens, colour::kView);
  const QImage& picture = levelImage(0);
  painter.drawImage(QRectF{middle - QPointF{(center.x() + 0.5) * zoom, (center.y() + 0.5) * zoom},
                           QSizeF{picture.width() * zoom, picture.height() * zoom}},
                    picture);
  painter.setPen(QPen{colour::kSelected, 1});
  painter.drawLine(middle - QPointF{kLoupeRadius, 0}, middle - QPointF{6, 0});
  painter.drawLine(middle + QPointF{6, 0}, middle + QPointF{kLoupeRadius, 0});
  painter.drawLine(middle - QPointF{0, kLoupeRadius}, middle - QPointF{0, 6});
  painter.drawLine(middle + QPointF{0, 6}, middle + QPointF{0, kLoupeRadius});
  painter.restore();
  painter.setPen(QPen{colour::kViewText, 1.5});
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(middle, kLoupeRadius, kLoupeRadius);
}

void RadiographView::paintScaleBar(QPainter& painter) const {
  const bool known = radiograph_->spacing && radiograph_->spacing->source != PixelScaleSource::None;
  const double unit = known ? zoom_ / radiograph_->spacing->column_mm : zoom_;  // logical pixels per mm (or px)
  double length = known ? 10 : 100;
  for (const double candidate : {20., 50., 100., 200., 500., 1000., 2000.})
    if (candidate * unit < width() * 0.4 && candidate > length) length = candidate;
  const QPointF from{14, height() - 16.0}, to{14 + length * unit, height() - 16.0};
  painter.setPen(QPen{colour::kViewText, 2});
  painter.drawLine(from, to);
  painter.drawLine(from - QPointF{0, 4}, from + QPointF{0, 4});
  painter.drawLine(to - QPointF{0, 4}, to + QPointF{0, 4});
  QFont small = font();
  small.setPixelSize(11);
  painter.setFont(small);
  QString text = known ? QStringLiteral("%1 mm").arg(length) : QStringLiteral("%1 px").arg(length);
  if (known && radiograph_->spacing->source == PixelScaleSource::ImagerAtDetector) text += tr(" at the detector");
  painter.drawText(from + QPointF{0, -8}, text);
}

void RadiographView::resizeEvent(QResizeEvent*) {
  if (fitted_) fit();
}

void RadiographView::mousePressEvent(QMouseEvent* event) {
  if (!radiograph_) return;
  setFocus(Qt::MouseFocusReason);
  press_ = last_ = event->position();
  if (event->button() == Qt::RightButton) {
    drag_ = Drag::Window;
    display_at_press_ = {windowCenter(), windowWidth(), display_.invert};
  } else if (event->button() == Qt::MiddleButton) {
    drag_ = Drag::Pan;
  } else if (event->button() == Qt::LeftButton) {
    if (const MarkOverlay* mark = placing_ ? nullptr : markAt(press_)) {
      dragged_mark_ = mark->name;
      grab_offset_px_ = mark->uv_px - toImage(press_);
      drag_ = Drag::Mark;
      emit markPressed(dragged_mark_);
    } else {
      drag_ = tool_ == Tool::Place ? Drag::Click : Drag::Pan;
    }
  }
  if (drag_ == Drag::Pan) setCursor(Qt::ClosedHandCursor);
}

void RadiographView::mouseMoveEvent(QMouseEvent* event) {
  if (!radiograph_) return;
  const QPointF here = event->position();
  cursor_ = here;
  const QPointF moved = here - press_;
  switch (drag_) {
    case Drag::Click:
      if (std::hypot(moved.x(), moved.y()) <= kClickSlack) break;
      drag_ = Drag::Pan;
      setCursor(Qt::ClosedHandCursor);
      [[fallthrough]];
    case Drag::Pan:
      center_px_ -= (here - last_) / zoom_;
      fitted_ = false;
      break;
    case Drag::Window: {  // right = wider, up = brighter, in proportion to the window
      DisplayWindow next = display_at_press_;
      const double base = *display_at_press_.width;
      next.width = clampedWindow(base * std::exp(moved.x() / 240));
      next.center = *display_at_press_.center + moved.y() * base / 400;
      setDisplay(next);
      emit displayChanged(next);
      break;
    }
    case Drag::Mark:
      if (std::hypot(moved.x(), moved.y()) > 1) emit markDragged(dragged_mark_, toImage(here) + grab_offset_px_);
      break;
    case Drag::None:
      break;
  }
  last_ = here;
  const QPointF uv = toImage(here);
  if (uv.x() >= -0.5 && uv.y() >= -0.5 && uv.x() < radiograph_->width_px - 0.5 &&
      uv.y() < radiograph_->height_px - 0.5)
    emit hovered(uv);
  else
    emit left();
  update();
}

void RadiographView::mouseReleaseEvent(QMouseEvent* event) {
  const Drag ended = drag_;
  drag_ = Drag::None;
  setCursor(tool_ == Tool::Place ? Qt::CrossCursor : Qt::ArrowCursor);
  if (!radiograph_) return;
  const QPointF moved = event->position() - press_;
  if (ended == Drag::Click) emit placed(toImage(event->position()));
  if (ended == Drag::Mark && std::hypot(moved.x(), moved.y()) > 1)
    emit markDropped(dragged_mark_, toImage(event->position()) + grab_offset_px_);
  update();
}

void RadiographView::wheelEvent(QWheelEvent* event) {
  setZoomAt(zoom_ * std::pow(1.2, event->angleDelta().y() / 120.0), event->position());
  event->accept();
}

void RadiographView::keyPressEvent(QKeyEvent* event) {
  const QPointF middle{width() / 2.0, height() / 2.0};
  switch (event->key()) {
    case Qt::Key_Escape:
      if (drag_ == Drag::Mark) {
        drag_ = Drag::None;
        emit markDragCancelled();
      } else {
        event->ignore();
      }
      break;
    case Qt::Key_F:
      fit();
      break;
    case Qt::Key_1:
      oneToOne();
      break;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      setZoomAt(zoom_ * 1.25, middle);
      break;
    case Qt::Key_Minus:
      setZoomAt(zoom_ / 1.25, middle);
      break;
    case Qt::Key_I: {
      DisplayWindow next = display_;
      next.invert = !next.invert;
      setDisplay(next);
      emit displayChanged(next);
      break;
    }
    default:
      QWidget::keyPressEvent(event);
  }
}

void RadiographView::leaveEvent(QEvent*) {
  cursor_.reset();
  update();
  emit left();
}

}  // namespace sinew
