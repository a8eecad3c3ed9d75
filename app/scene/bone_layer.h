#pragma once
#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <string>
#include <vector>

#include "app/scene/palette.h"
#include "core/model/model.h"

class vtkRenderer;

namespace sinew {

/// One actor a bone; a posture only changes their matrices.
class BoneLayer {
 public:
  explicit BoneLayer(vtkRenderer& renderer) : renderer_{renderer} {}

  void setBones(std::shared_ptr<const std::vector<BoneMesh>> bones);
  void setPoses(const std::vector<RigidTransform>& X_WB);
  void setVisible(bool visible);
  void setOpacity(double opacity);
  void select(const std::string& bone);
  void setColour(const Rgb& colour);
  /// Name of the bone that an actor draws; empty if it is none of them.
  std::string nameOf(const vtkProp* actor) const;

 private:
  struct Bone {
    std::string name;
    int segment;
    vtkSmartPointer<vtkActor> actor;
  };
  vtkRenderer& renderer_;
  std::vector<Bone> bones_;
  std::shared_ptr<const std::vector<BoneMesh>> shown_;
  bool visible_ = true;
  double opacity_ = 1;
  Rgb colour_ = palette::kBone;
  std::string selected_;
};

}  // namespace sinew
