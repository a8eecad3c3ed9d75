#include <cmath>

#include "core/file.h"
#include "core/model/deformed_bones_internal.h"
#include "core/model/model.h"
#include "core/model/musculature_json.h"
#include "core/model/skeleton_json.h"
#include "core/skeleton/shape_json.h"

namespace sinew {

void saveModel(const Model& model, const std::filesystem::path& file) {
  Json factors = Json::object();
  for (const auto& [unit, factor] : model.length_factors) factors[unit] = factor;
  const Json root{
      {"format", "sinew.model"},
      {"version", 1},
      {"frames", "world and segments: X anterior, Y superior, Z right; metres, radians, kilograms, newtons"},
      {"name", model.name},
      {"shape", shapeToJson(model.shape)},
      {"skeleton", skeletonToJson(model.skeleton)},
      {"muscles", musculatureToJson(model.musculature, model.skeleton)},
      {"length_factors", factors}};
  writeFileAtomically(file, jsonText(root));
}

Model loadModel(const std::filesystem::path& file, const Model& reference) {
  const std::string where = file.filename().string();
  const Json root = parseJson(readFile(file), where);
  const JsonReader json{root, where};
  json.expectFormat("sinew.model", 1);
  json.allowOnly({"format", "version", "frames", "name", "shape", "skeleton", "muscles", "length_factors"});
  Model model;
  model.name = json["name"].text();
  model.shape = shapeFromJson(json["shape"]);
  model.skeleton = skeletonFromJson(json["skeleton"]);
  model.musculature = musculatureFromJson(json["muscles"], model.skeleton);
  for (const auto& [unit, factor] : json["length_factors"].members()) {
    namedIndex(factor, unit, [&](const std::string& name) { return model.musculature.unitIndex(name); });
    model.length_factors[unit] = factor.positive();
  }
  model.bones = deformedBones(reference, model.shape, model.skeleton);
  return model;
}

Model loadModelByName(const std::string& name_or_file, const std::filesystem::path& resource_dir) {
  if (const auto preset = presetOf(name_or_file)) return loadReferenceModel(resource_dir, *preset);
  return loadModel(name_or_file, loadReferenceModel(resource_dir));
}

}  // namespace sinew
