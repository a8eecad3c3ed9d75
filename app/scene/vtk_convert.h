#pragma once
#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "core/geometry/rigid_transform.h"
#include "core/geometry/triangle_mesh.h"

namespace sinew {

/// Points, triangles and vertex normals.
vtkSmartPointer<vtkPolyData> toPolyData(const TriangleMesh& mesh);

vtkSmartPointer<vtkMatrix4x4> toMatrix(const RigidTransform& X);

/// `actor` shows these lines as tubes.
void drawTube(vtkActor& actor, vtkPolyData* lines, double radius_m);

}  // namespace sinew
