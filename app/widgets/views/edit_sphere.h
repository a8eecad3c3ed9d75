#pragma once
#include "app/model/retarget/rom_handles.h"
#include "app/widgets/views/rom_sphere_view.h"

namespace sinew {

/// The sphere of a ball joint with the wanted range and its cone: drag the ball in the middle to tilt the cone, the
/// ball on the border to widen or narrow it. Elsewhere the mouse turns the sphere.
class EditSphere : public RomSphereView {
  Q_OBJECT
 public:
  explicit EditSphere(const QString& object_name, QWidget* parent = nullptr);

  void setCone(const BallRange& range);
  bool isHeld() const { return held_ != Grip::None; }

 signals:
  void centrePulled(const Eigen::Vector3d& direction_J);
  void borderPulled(const Eigen::Vector3d& direction_J);
  void released();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  enum class Grip { None, Centre, Border };
  /// A little more than the balls, so that a hand need not be exact.
  Grip gripAt(const QPointF& position) const;
  Eigen::Vector3d directionAt(const QPointF& position) const;

  BallRange range_;
  Grip held_ = Grip::None;
};

}  // namespace sinew
