#include "core/model/bone_meshes.h"
#include "core/model/model.h"
#include "core/muscle/load_musculature.h"

namespace sinew {

Model loadReferenceModel(const std::filesystem::path& resource_dir) {
  Model model;
  model.skeleton = loadReferenceSkeleton(resource_dir);
  model.musculature = loadMusculature(resource_dir, model.skeleton);
  model.bones = loadBoneMeshes(resource_dir, model.skeleton);
  return model;
}

}  // namespace sinew
