#include "core/model/bone_meshes.h"
#include "core/model/model.h"
#include "core/model/rom_preset.h"
#include "core/muscle/load_musculature.h"

namespace sinew {

Model loadReferenceModel(const std::filesystem::path& resource_dir, std::string_view preset) {
  Model model;
  if (preset != kDefaultPreset) model.name += ":" + std::string{preset};
  model.skeleton = loadReferenceSkeleton(resource_dir);
  setStops(model.skeleton, loadRomPreset(resource_dir, preset, model.skeleton));
  PassiveStructures structures = loadPassiveStructures(resource_dir, model.skeleton, preset);
  model.passive_moments = passiveMomentsAtStops(structures, model.skeleton);
  model.laxity = std::move(structures.laxity);
  model.musculature = loadMusculature(resource_dir, model.skeleton, preset);
  model.bones = loadBoneMeshes(resource_dir, model.skeleton);
  return model;
}

std::optional<std::string> presetOf(const std::string& model_name) {
  constexpr std::string_view kReference = "reference";
  if (model_name == kReference) return std::string{kDefaultPreset};
  if (!model_name.starts_with(std::string{kReference} + ":")) return std::nullopt;
  return model_name.substr(kReference.size() + 1);
}

}  // namespace sinew
