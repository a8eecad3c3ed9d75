#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "app/scene/palette.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

/// Colour of a direction by the width of its twist range: yellow (narrow) over orange to dark red (`widest_rad`).
/// Darkens evenly, so that it reads in grey.
Rgb romColour(double width_rad, double widest_rad);

/// The directions that the shaft can take, as a patch of a sphere about the joint centre, in the joint frame J; one
/// colour a cell (cell data "colour").
vtkSmartPointer<vtkPolyData> romPatch(const RomMap& map, double radius_m, double widest_rad);

/// The border of that patch: lines on the sphere.
vtkSmartPointer<vtkPolyData> romBorder(const RomMap& map, double radius_m);

/// Circles of latitude about the resting shaft and meridians, every 30 degrees: to read angles on the sphere.
vtkSmartPointer<vtkPolyData> romGraticule(const RomMapFrame& frame, double radius_m);

}  // namespace sinew
