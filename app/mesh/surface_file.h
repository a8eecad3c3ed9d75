#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace sinew {

/// Endings of the surface files that can be read, with the dot: ".stl", ".ply", ".obj", ".vtp".
const std::vector<std::string>& surfaceFileEndings();
bool isSurfaceFile(const std::filesystem::path& file);

/// Triangles of a surface file, polygons split. Coordinates are multiplied by `unit_m` (0.001 for a file in
/// millimetres): none of the formats says what its unit is.
/// @throws InputError if the file cannot be read, is of another format or holds no triangle.
TriangleMesh readSurfaceFile(const std::filesystem::path& file, double unit_m);

}  // namespace sinew
