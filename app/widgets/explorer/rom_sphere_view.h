#pragma once
#include <QLabel>
#include <QWidget>
#include <memory>
#include <optional>

#include "core/rom/rom_map.h"

namespace sinew {

class RomSphereScene;
class VtkView;

/// One map on its sphere. On a platform without OpenGL a still picture of the same scene takes its place.
class RomSphereView : public QWidget {
  Q_OBJECT
 public:
  explicit RomSphereView(const QString& object_name, QWidget* parent = nullptr);
  ~RomSphereView() override;

  void setCaption(const QString& caption);
  /// The one before stays until the next is drawn.
  void setMap(const RomMap& map, double widest_rad, const Eigen::Vector3d& shaft_J);
  void setShaft(const Eigen::Vector3d& shaft_J);
  void turnWith(RomSphereView& other);
  bool hasMap() const { return map_.has_value(); }

 private:
  void redraw();

  VtkView* vtk_ = nullptr;
  std::unique_ptr<RomSphereScene> scene_;
  QLabel *still_ = nullptr, *caption_;
  std::optional<RomMap> map_;
  double widest_rad_ = 0;
  Eigen::Vector3d shaft_J_ = -Eigen::Vector3d::UnitY();
};

}  // namespace sinew
