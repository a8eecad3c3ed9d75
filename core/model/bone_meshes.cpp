#include "core/model/bone_meshes.h"

#include <utility>

#include "core/geometry/mesh_io.h"

namespace sinew {

TriangleMesh mirrored(const TriangleMesh& mesh) {
  TriangleMesh image = mesh;
  for (auto& v : image.vertices) v.z() = -v.z();
  for (auto& t : image.triangles) std::swap(t[1], t[2]);
  return image;
}

std::shared_ptr<const std::vector<BoneMesh>> loadBoneMeshes(const std::filesystem::path& resource_dir,
                                                            const Skeleton& skeleton) {
  const auto leftName = [](const std::string& name) {
    return name.ends_with("_r") ? std::string{withoutSide(name)} + "_l" : name;
  };
  auto bones = std::make_shared<std::vector<BoneMesh>>();
  for (auto& [bone, segment, mesh] : readMeshes(resource_dir / "skeleton" / "bone_meshes.bin")) {
    const std::string left = leftName(bone);
    if (left != bone) bones->push_back({left, skeleton.segmentIndex(leftName(segment)), mirrored(mesh)});
    bones->push_back({bone, skeleton.segmentIndex(segment), std::move(mesh)});
  }
  return bones;
}

}  // namespace sinew
