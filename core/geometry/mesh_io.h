#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace sinew {

/// A bone surface as stored: right side and midline, in the frame of its segment.
struct NamedMesh {
  std::string bone;     ///< "femur_r"
  std::string segment;  ///< "femur_r"
  TriangleMesh mesh;
};

// One compact binary file, little endian: "SINEWMSH", u32 version 1, u32 mesh count; per mesh two strings (u16 length
// + bytes), u32 vertex and triangle counts, the bounding box as six f32 [m], vertices as three u16 each (0-65535
// across the box: 4 um for a femur), triangles as three u32 each. Quantizing keeps shared vertices shared.

/// @throws InputError if the file cannot be written.
void writeMeshes(const std::vector<NamedMesh>& meshes, const std::filesystem::path& file);
/// @throws InputError for a file that is not such a file, of another version, truncated or with impossible indices.
std::vector<NamedMesh> readMeshes(const std::filesystem::path& file);

/// One surface as Wavefront OBJ text, metres.
std::string objText(const TriangleMesh& mesh);

}  // namespace sinew
