#pragma once
#include <vtkActor.h>
#include <vtkNew.h>

#include "core/rom/maps/rom_map.h"

class vtkRenderer;

namespace sinew {

/// Where a ball joint lets its bone point: a coloured patch of a sphere about the joint centre, with its border, the
/// angles as thin lines on the rest of the sphere, and the present direction of the shaft.
class RomLayer {
 public:
  explicit RomLayer(vtkRenderer& renderer);

  /// `widest_rad`: the twist range that gets the darkest colour.
  void draw(const RomMap& map, double radius_m, double widest_rad);
  /// The joint frame, and the direction of the shaft in it.
  void setPose(const RigidTransform& X_WJ, const Eigen::Vector3d& shaft_J);
  void setVisible(bool visible);
  void setGraticuleColour(double grey);

 private:
  vtkNew<vtkActor> patch_, border_, graticule_, shaft_, tip_;
  double radius_m_ = 0;
};

}  // namespace sinew
