#include "app/widgets/views/edit_sphere.h"

#include <QMouseEvent>
#include <cmath>

#include "app/widgets/views/vtk_view.h"

namespace sinew {

EditSphere::EditSphere(const QString& object_name, QWidget* parent) : RomSphereView{object_name, parent} {
  if (vtkView()) {
    vtkView()->installEventFilter(this);
    vtkView()->setToolTip(
        tr("Drag the ball in the middle to tilt the cone, the one on its border to widen or narrow it"));
  }
}

void EditSphere::setCone(const BallRange& range) {
  range_ = range;
  setHandles(RomHandles{range.centre_J, range.cone_rad});
}

Eigen::Vector3d EditSphere::directionAt(const QPointF& position) const {
  const double ratio = vtkView()->devicePixelRatioF();
  return scene()->directionAt(position.x() * ratio, (vtkView()->height() - position.y()) * ratio - 1);
}

EditSphere::Grip EditSphere::gripAt(const QPointF& position) const {
  constexpr double kReach_px = 12;
  const double ratio = vtkView()->devicePixelRatioF();
  const auto distance_px = [&](const Eigen::Vector3d& direction_J) {
    const Eigen::Vector2d at_px = scene()->pixelOf(direction_J), at = at_px / ratio;
    constexpr double kSeen = 0.9;  // else it lies on the far side
    if (scene()->directionAt(at_px.x(), at_px.y()).dot(direction_J) < kSeen) return double(INFINITY);
    return std::hypot(at.x() - position.x(), vtkView()->height() - at.y() - position.y());
  };
  const double border_px = distance_px(scene()->borderHandle_J()), centre_px = distance_px(range_.centre_J);
  if (std::min(border_px, centre_px) > kReach_px) return Grip::None;
  return border_px < centre_px ? Grip::Border : Grip::Centre;
}

bool EditSphere::eventFilter(QObject* watched, QEvent* event) {
  if (watched != vtkView() || !hasMap()) return RomSphereView::eventFilter(watched, event);
  switch (event->type()) {
    case QEvent::MouseButtonPress: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      if (mouse->button() != Qt::LeftButton) break;
      held_ = gripAt(mouse->position());
      if (held_ == Grip::None) break;
      vtkView()->setFocus(Qt::MouseFocusReason);
      return true;
    }
    case QEvent::MouseMove: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      if (held_ == Grip::None) {
        if (mouse->buttons() == Qt::NoButton)
          vtkView()->setCursor(gripAt(mouse->position()) == Grip::None ? Qt::ArrowCursor : Qt::OpenHandCursor);
        break;
      }
      const Eigen::Vector3d direction_J = directionAt(mouse->position());
      if (held_ == Grip::Centre)
        emit centrePulled(direction_J);
      else
        emit borderPulled(direction_J);
      return true;
    }
    case QEvent::MouseButtonRelease:
      if (held_ == Grip::None) {
        if (scene()) setCone(range_);  // the handle on the border follows a turned sphere
        break;
      }
      held_ = Grip::None;
      emit released();
      return true;
    default:
      break;
  }
  return RomSphereView::eventFilter(watched, event);
}

}  // namespace sinew
