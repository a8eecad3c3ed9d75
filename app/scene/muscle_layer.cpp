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

  outline_tube_->SetInputData(outline_line_);
  outline_tube_->SetNumberOfSides(14);
  outline_tube_->CappingOn();
  outline_tube_->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  vtkNew<vtkPolyDataMapper> outline_mapper;
  outline_mapper->SetInputConnection(outline_tube_->GetOutputPort());
  outline_mapper->ScalarVisibilityOff();
  outline_->SetMapper(outline_mapper);
  outline_->PickableOff();
  outline_->GetProperty()->FrontfaceCullingOn();  // only the far side of a wider tube shows: an edge
  outline_->GetProperty()->LightingOff();
  outline_->GetProperty()->SetColor(palette::kSelection.r, palette::kSelection.g, palette::kSelection.b);
  renderer.AddActor(outline_);

  thread_tube_->SetInputData(outline_line_);
  thread_tube_->SetNumberOfSides(6);
  thread_tube_->SetRadius(0.0024);
  vtkNew<vtkPolyDataMapper> thread_mapper;
  thread_mapper->SetInputConnection(thread_tube_->GetOutputPort());
  thread_mapper->ScalarVisibilityOff();
  thread_mapper->SetResolveCoincidentTopologyToPolygonOffset();
  thread_mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(0, -66000);  // in front of every bone
  thread_->SetMapper(thread_mapper);
  thread_->PickableOff();
  thread_->GetProperty()->LightingOff();
  thread_->GetProperty()->SetColor(palette::kSelection.r, palette::kSelection.g, palette::kSelection.b);
  renderer.AddActor(thread_);
}

void MuscleLayer::outline(const MusculotendonUnit* unit, const std::vector<RigidTransform>& X_WB) {
  constexpr double kEdge_m = 0.0028;
  outline_line_->Initialize();
  if (unit) {
    const auto spindle = muscleSpindle(*unit, pathPoints(*unit, X_WB));
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkDoubleArray> radius;
    cells->InsertNextCell(int(spindle.points.size()));
    for (std::size_t k = 0; k < spindle.points.size(); ++k) {
      cells->InsertCellPoint(points->InsertNextPoint(spindle.points[k].data()));
      radius->InsertNextValue(spindle.radius_m[k] + kEdge_m);
    }
    outline_line_->SetPoints(points);
    outline_line_->SetLines(cells);
    outline_line_->SetLines(cells);
    outline_line_->GetPointData()->SetScalars(radius);
  }
  outline_line_->Modified();
}

void MuscleLayer::setVisible(bool visible) {
  actor_->SetVisibility(visible);
  outline_->SetVisibility(visible);
  thread_->SetVisibility(visible);
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
