#pragma once
#include <vtkActor.h>
#include <vtkNew.h>

#include <optional>

#include "core/rom/maps/rom_map.h"

class vtkRenderer;

namespace sinew {

/// What a hand takes hold of on the sphere of a ball joint: the circle of a cone with a ball on its middle and one on
/// its border; and the border of a map that another one is compared with.
class RomHandleLayer {
 public:
  explicit RomHandleLayer(vtkRenderer& renderer);

  void setOutline(const std::optional<RomMap>& map, double radius_m);
  /// Unit directions in the joint frame.
  void draw(const Eigen::Vector3d& centre_J, double cone_rad, const Eigen::Vector3d& border_J, double radius_m);
  void hide();

 private:
  vtkNew<vtkActor> outline_, circle_, centre_, border_;
};

}  // namespace sinew
