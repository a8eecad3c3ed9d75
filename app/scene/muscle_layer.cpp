#include "app/scene/muscle_layer.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "app/scene/muscle_shape.h"
#include "core/muscle/muscle_path.h"

namespace sinew {
namespace {
constexpr const char* kUnit = "unit";
constexpr const char* kColour = "colour";
}  // namespace

MuscleLayer::MuscleLayer(vtkRenderer& renderer) {
  tubes_->SetInputData(lines_);
  tubes_->SetNumberOfSides(10);
  tubes_->CappingOn();
  tubes_->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tubes_->GetOutputPort());
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray(kColour);
  actor_->SetMapper(mapper);
  actor_->GetProperty()->SetAmbient(0.12);
  actor_->GetProperty()->SetDiffuse(0.88);
  actor_->GetProperty()->SetSpecular(0.18);
  actor_->GetProperty()->SetSpecularPower(22);
  renderer.AddActor(actor_);
}

void MuscleLayer::draw(const Musculature& musculature, const std::vector<int>& shown,
                       const std::vector<RigidTransform>& X_WB, const std::function<Rgb(int)>& colour_of) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkDoubleArray> radius;
  vtkNew<vtkIntArray> unit_of_cell;
  unit_of_cell->SetName(kUnit);
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName(kColour);
  colours->SetNumberOfComponents(3);
  for (const int i : shown) {
    const auto& unit = musculature.units[i];
    const auto spindle = muscleSpindle(unit, pathPoints(unit, X_WB));
    if (spindle.points.empty()) continue;
    cells->InsertNextCell(int(spindle.points.size()));
    for (std::size_t k = 0; k < spindle.points.size(); ++k) {
      cells->InsertCellPoint(points->InsertNextPoint(spindle.points[k].data()));
      radius->InsertNextValue(spindle.radius_m[k]);
    }
    unit_of_cell->InsertNextValue(i);
    const Rgb c = colour_of(i);
    colours->InsertNextTuple3(255 * c.r, 255 * c.g, 255 * c.b);
  }
  lines_->Initialize();
  lines_->SetPoints(points);
  lines_->SetLines(cells);
  lines_->GetPointData()->SetScalars(radius);
  lines_->GetCellData()->AddArray(unit_of_cell);
  lines_->GetCellData()->AddArray(colours);
  lines_->Modified();
}

int MuscleLayer::unitOfCell(vtkIdType cell) const {
  auto* units =
      vtkIntArray::SafeDownCast(const_cast<MuscleLayer*>(this)->tubes_->GetOutput()->GetCellData()->GetArray(kUnit));
  return units && cell >= 0 && cell < units->GetNumberOfValues() ? units->GetValue(cell) : -1;
}

}  // namespace sinew
