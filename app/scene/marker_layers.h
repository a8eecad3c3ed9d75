#pragma once
#include <vtkActor.h>
#include <vtkGlyph3D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <array>
#include <string>
#include <vector>

#include "core/model/model.h"

class vtkRenderer;

namespace sinew {

/// Centres of hip, knee and ankle of one leg.
struct LegAxes {
  Eigen::Vector3d hip_W, knee_W, ankle_W;
};
/// Right and left, from the origins of femur, tibia and foot; what a skeleton lacks is left out.
std::vector<LegAxes> legAxes(const Skeleton& skeleton, const std::vector<RigidTransform>& X_WB);

/// Mechanical axes of femur and tibia (vermilion) and the load line from hip to ankle (blue), seen through the bones.
class AxesLayer {
 public:
  explicit AxesLayer(vtkRenderer& renderer);
  void draw(const std::vector<LegAxes>& legs);
  void setVisible(bool visible);

 private:
  struct Lines {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkActor> actor;
  };
  Lines bone_axes_, load_line_, centres_;
  vtkNew<vtkGlyph3D> balls_;
};

/// Landmarks of the skeleton as small balls.
class LandmarkLayer {
 public:
  explicit LandmarkLayer(vtkRenderer& renderer);
  void draw(const Skeleton& skeleton, const std::vector<RigidTransform>& X_WB);
  void setVisible(bool visible) { actor_->SetVisibility(visible); }
  bool draws(const vtkProp* actor) const { return actor == actor_.Get(); }
  /// Index of the landmark drawn nearest to a point; -1 without landmarks.
  int nearest(const Eigen::Vector3d& p_W) const;

 private:
  std::vector<Eigen::Vector3d> p_W_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkGlyph3D> balls_;
  vtkNew<vtkActor> actor_;
};

}  // namespace sinew
