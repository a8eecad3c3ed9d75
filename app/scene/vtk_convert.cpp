#include "app/scene/vtk_convert.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkTubeFilter.h>

namespace sinew {

vtkSmartPointer<vtkPolyData> toPolyData(const TriangleMesh& mesh) {
  const auto count = vtkIdType(mesh.vertices.size());
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(count);
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  const auto n = vertexNormals(mesh);
  for (vtkIdType i = 0; i < count; ++i) {
    points->SetPoint(i, mesh.vertices[i].data());
    normals->SetTuple(i, n[i].data());
  }
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : mesh.triangles) triangles->InsertNextCell({t[0], t[1], t[2]});

  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(triangles);
  data->GetPointData()->SetNormals(normals);
  return data;
}

vtkSmartPointer<vtkMatrix4x4> toMatrix(const RigidTransform& X) {
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) matrix->SetElement(i, j, X(i, j));
  return matrix;
}

void drawTube(vtkActor& actor, vtkPolyData* lines, double radius_m) {
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(lines);
  tube->SetRadius(radius_m);
  tube->SetNumberOfSides(8);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tube->GetOutputPort());
  mapper->ScalarVisibilityOff();
  actor.SetMapper(mapper);
}

}  // namespace sinew
