#include <algorithm>
#include <cmath>

#include "core/file.h"
#include "core/geometry/mesh_io.h"
#include "core/model/deformed_bones_internal.h"
#include "core/model/model.h"
#include "core/model/musculature_json.h"
#include "core/model/passive_json.h"
#include "core/model/skeleton_json.h"
#include "core/skeleton/shape/shape_json.h"

namespace sinew {
namespace {

/// Writes the bones that a person supplied beside the model file; null if there are none.
Json saveSuppliedBones(const Model& model, const std::filesystem::path& model_file) {
  std::vector<NamedMesh> meshes;
  for (const BoneMesh& bone : *model.bones)
    if (bone.supplied)
      meshes.push_back({bone.bone, model.skeleton.segments[static_cast<std::size_t>(bone.segment)].name, bone.mesh});
  if (meshes.empty()) return nullptr;
  const std::filesystem::path file = std::filesystem::path{model_file}.replace_extension(".bones.bin");
  writeMeshes(meshes, file);
  return {{"file", file.filename().string()}, {"sha256", sha256OfFile(file)}};
}

/// Puts the bones of such a file into the place of those of the same name.
std::shared_ptr<const std::vector<BoneMesh>> withSuppliedBones(const std::vector<BoneMesh>& bones,
                                                               const JsonReader& json,
                                                               const std::filesystem::path& folder,
                                                               const Skeleton& skeleton) {
  json.allowOnly({"file", "sha256"});
  const std::filesystem::path name = json["file"].text();
  if (name.empty() || name != name.filename()) json["file"].fail("the name of a file beside the model");
  const std::string found = sha256OfFile(folder / name);
  if (found != json["sha256"].text()) json["sha256"].fail(json["sha256"].text(), found + " in " + name.string());
  auto all = std::make_shared<std::vector<BoneMesh>>(bones);
  for (auto& [bone, segment, mesh] : readMeshes(folder / name)) {
    const auto place = std::ranges::find(*all, bone, &BoneMesh::bone);
    if (place == all->end()) json["file"].fail("bones of the reference", "'" + bone + "'");
    *place = {bone, skeleton.segmentIndex(segment), std::move(mesh), true};
  }
  return all;
}

}  // namespace

void saveModel(const Model& model, const std::filesystem::path& file) {
  Json factors = Json::object();
  for (const auto& [unit, factor] : model.length_factors) factors[unit] = factor;
  Json root{{"format", "sinew.model"},
            {"version", 1},
            {"frames", "world and segments: X anterior, Y superior, Z right; metres, radians, kilograms, newtons"},
            {"name", model.name},
            {"shape", shapeToJson(model.shape)},
            {"skeleton", skeletonToJson(model.skeleton)},
            {"passive_moments", passiveMomentsToJson(model.passive_moments, model.skeleton)},
            {"muscles", musculatureToJson(model.musculature, model.skeleton)},
            {"length_factors", factors}};
  if (model.physics) root["physics"] = physicsFactorsToJson(*model.physics);
  const Json bones = saveSuppliedBones(model, file);
  if (!bones.is_null()) root["bones"] = bones;
  writeFileAtomically(file, jsonText(root));
}

Model loadModel(const std::filesystem::path& file, const Model& reference) {
  const std::string where = file.filename().string();
  const Json root = parseJson(readFile(file), where);
  const JsonReader json{root, where};
  json.expectFormat("sinew.model", 1);
  json.allowOnly({"format", "version", "frames", "name", "shape", "skeleton", "passive_moments", "muscles",
                  "length_factors", "physics", "bones"});
  Model model;
  model.name = json["name"].text();
  model.shape = shapeFromJson(json["shape"]);
  model.skeleton = skeletonFromJson(json["skeleton"]);
  if (const auto moments = json.find("passive_moments"))
    model.passive_moments = passiveMomentsFromJson(*moments, model.skeleton);
  else
    model.passive_moments = scaledStructures(reference.passive_moments, reference.skeleton, model.skeleton);
  model.laxity = reference.laxity;
  model.musculature = musculatureFromJson(json["muscles"], model.skeleton);
  for (const auto& [unit, factor] : json["length_factors"].members()) {
    namedIndex(factor, unit, [&](const std::string& name) { return model.musculature.unitIndex(name); });
    model.length_factors[unit] = factor.positive();
  }
  if (const auto physics = json.find("physics")) model.physics = physicsFactorsFromJson(*physics);
  model.bones = deformedBones(reference, model.shape, model.skeleton);
  if (const auto bones = json.find("bones"))
    model.bones = withSuppliedBones(*model.bones, *bones, file.parent_path(), model.skeleton);
  return model;
}

Model loadModelByName(const std::string& name_or_file, const std::filesystem::path& resource_dir) {
  if (const auto preset = presetOf(name_or_file)) return loadReferenceModel(resource_dir, *preset);
  return loadModel(name_or_file, loadReferenceModel(resource_dir));
}

}  // namespace sinew
