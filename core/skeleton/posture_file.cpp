#include "core/skeleton/posture_file.h"

#include "core/error.h"
#include "core/file.h"
#include "core/skeleton/clinical_angles.h"
#include "core/strict_json.h"

namespace sinew {
namespace {

NamedPosture readPosture(const JsonReader& item, const Skeleton& skeleton) {
  item.allowOnly({"name", "coordinates_deg"});
  const std::string name_of_posture = item["name"].text();
  std::map<std::string, double> coordinates_deg;
  for (const auto& [name, value] : item["coordinates_deg"].members()) coordinates_deg[name] = value.number();
  try {
    return {name_of_posture, postureFromDegrees(skeleton, coordinates_deg)};
  } catch (const InputError& error) {
    throw InputError{
        {item.where(), item.path() + ".coordinates_deg", error.detail().expected, error.detail().found}};
  }
}

}  // namespace

std::vector<NamedPosture> loadPostures(const std::filesystem::path& file, const Skeleton& skeleton) {
  constexpr std::uintmax_t kLargest_bytes = std::uintmax_t{256} << 20;
  const Json json = parseJson(readFile(file, kLargest_bytes), file.string());
  const JsonReader reader{json, file.string()};
  std::vector<NamedPosture> postures;
  if (json.is_object()) {
    reader.expectFormat("sinew.postures", 1);
    reader.allowOnly({"format", "version", "source", "postures"});
  }
  for (const auto& item : (json.is_object() ? reader["postures"] : reader).items())
    postures.push_back(readPosture(item, skeleton));
  return postures;
}

std::vector<NamedPosture> loadPresetPostures(const std::filesystem::path& resource_dir, const Skeleton& skeleton) {
  return loadPostures(resource_dir / "skeleton" / "preset_postures.json", skeleton);
}

}  // namespace sinew
