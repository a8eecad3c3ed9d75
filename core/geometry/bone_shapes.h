#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/implicit_surface.h"

namespace sinew {

/// A bone, or a group of bones that move together, as implicit solids in the frame of its segment, metres.
/// Only the right side and the midline are described; the left side is the mirror image z -> -z.
struct BoneShape {
  std::string name;                     ///< "femur_r", "sacrum"
  std::string segment;                  ///< "femur_r", "pelvis"
  double voxel_m = 0.0015;              ///< fineness of its mesh
  int triangles = 4000;                 ///< size of its mesh, all pieces together
  std::vector<ImplicitSurface> pieces;  ///< closed solids that do not blend (the single bones of a tarsus)

  /// Signed distance to the nearest piece.
  double distance(const Eigen::Vector3d& p) const;
};

/// Reads every file of skeleton/bones/ ("sinew.bones", version 1; millimetres in the file), in the order of file
/// names.
/// @throws InputError naming file, bone, part and field.
std::vector<BoneShape> loadBoneShapes(const std::filesystem::path& resource_dir);
/// One such file.
std::vector<BoneShape> readBoneShapes(const std::string& text, const std::string& where);

}  // namespace sinew
