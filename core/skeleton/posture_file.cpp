#include "core/skeleton/posture_file.h"

#include "core/error.h"
#include "core/file.h"
#include "core/skeleton/clinical_angles.h"
#include "core/strict_json.h"

namespace sinew {

void readPostures(
    const std::filesystem::path& file,
    const std::function<void(const std::string& name, const std::map<std::string, double>& coordinates_deg)>& take) {
  constexpr std::uintmax_t kLargest_bytes = std::uintmax_t{256} << 20;
  const Json json = parseJson(readFile(file, kLargest_bytes), file.string());
  const JsonReader reader{json, file.string()};
  if (json.is_object()) {
    reader.expectFormat("sinew.postures", 1);
    reader.allowOnly({"format", "version", "source", "postures"});
  }
  for (const auto& item : (json.is_object() ? reader["postures"] : reader).items()) {
    item.allowOnly({"name", "coordinates_deg"});
    const std::string posture = item["name"].text();
    std::map<std::string, double> coordinates_deg;
    for (const auto& [name, value] : item["coordinates_deg"].members()) coordinates_deg[name] = value.number();
    try {
      take(posture, coordinates_deg);
    } catch (const InputError& error) {
      throw InputError{
          {item.where(), item.path() + ".coordinates_deg", error.detail().expected, error.detail().found}};
    }
  }
}

std::vector<NamedPosture> loadPostures(const std::filesystem::path& file, const Skeleton& skeleton) {
  std::vector<NamedPosture> postures;
  readPostures(file, [&](const std::string& name, const std::map<std::string, double>& coordinates_deg) {
    postures.push_back({name, postureFromDegrees(skeleton, coordinates_deg)});
  });
  return postures;
}

std::vector<NamedPosture> loadPresetPostures(const std::filesystem::path& resource_dir, const Skeleton& skeleton) {
  return loadPostures(resource_dir / "skeleton" / "preset_postures.json", skeleton);
}

}  // namespace sinew
