#pragma once
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTubeFilter.h>

#include <functional>
#include <string>
#include <vector>

#include "app/scene/palette.h"
#include "core/model/model.h"

class vtkRenderer;

namespace sinew {

/// All muscles in one actor: a tube a unit, coloured by cell.
class MuscleLayer {
 public:
  explicit MuscleLayer(vtkRenderer& renderer);

  /// Draws `shown` units of `musculature` (indices) at the poses, coloured by `colour_of(unit index)`.
  void draw(const Musculature& musculature, const std::vector<int>& shown, const std::vector<RigidTransform>& X_WB,
            const std::function<Rgb(int)>& colour_of);
  /// Draws a bright edge around one unit, and a thin line that shows through the body; nullptr: around none.
  void outline(const MusculotendonUnit* unit, const std::vector<RigidTransform>& X_WB);
  void setVisible(bool visible);
  bool draws(const vtkProp* actor) const { return actor == actor_.Get(); }
  /// Unit index of a cell of the drawn surface.
  int unitOfCell(vtkIdType cell) const;

 private:
  vtkNew<vtkPolyData> lines_;
  vtkNew<vtkTubeFilter> tubes_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkPolyData> outline_line_;
  vtkNew<vtkTubeFilter> outline_tube_;
  vtkNew<vtkTubeFilter> thread_tube_;
  vtkNew<vtkActor> outline_, thread_;
};

}  // namespace sinew
