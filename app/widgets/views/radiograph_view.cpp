#include "app/widgets/views/radiograph_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "app/model/image_store.h"

namespace sinew {
namespace {

constexpr double kGrabRadius = 9;  // logical pixels around a mark that take hold of it
constexpr double kClickSlack = 4;  // a press that moves less is a click
constexpr double kMaxZoom = 16;

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
