#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "core/model/model.h"

namespace sinew {

/// Surfaces of all bones of both sides from skeleton/bone_meshes.bin; every piece is closed, so attenuation can be
/// integrated through it. Left bones mirror the right ones (and are wound anew, so that they face outwards too).
/// Meshes called costal_cartilages_* are cartilage: to be drawn, but nearly invisible to X-rays.
/// @throws InputError if the file is missing or damaged or names a segment that the skeleton lacks.
std::shared_ptr<const std::vector<BoneMesh>> loadBoneMeshes(const std::filesystem::path& resource_dir,
                                                            const Skeleton& skeleton);

/// z -> -z with the winding turned.
TriangleMesh mirrored(const TriangleMesh& mesh);

}  // namespace sinew
