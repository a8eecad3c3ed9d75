#pragma once
#include <QLabel>
#include <QWidget>
#include <memory>
#include <optional>

#include "app/scene/rom_sphere.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

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
  /// The border of another map beside the coloured one; nullopt: none.
  void setOutline(const std::optional<RomMap>& map);
  void setHandles(const std::optional<RomHandles>& handles);
  VtkView* vtkView() const { return vtk_; }               ///< nullptr on a platform without OpenGL
  RomSphereScene* scene() const { return scene_.get(); }  ///< likewise
  bool hasMap() const { return map_.has_value(); }

 private:
  void redraw();

  VtkView* vtk_ = nullptr;
  std::unique_ptr<RomSphereScene> scene_;
  QLabel *still_ = nullptr, *caption_;
  std::optional<RomMap> map_;
  std::optional<RomMap> outline_;
  std::optional<RomHandles> handles_;
  double widest_rad_ = 0;
  Eigen::Vector3d shaft_J_ = -Eigen::Vector3d::UnitY();
};

}  // namespace sinew
