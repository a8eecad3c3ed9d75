#include "core/skeleton/shape/body_description.h"

#include <algorithm>

#include "core/file.h"
#include "core/skeleton/shape/shape_json.h"
#include "core/text.h"

namespace sinew {

BodyDescription loadBodyDescription(const std::filesystem::path& file) {
  const std::string where = file.filename().string();
  const Json document = parseJson(readFile(file), where);
  BodyDescription body = bodyFromJson(JsonReader{document, where});
  if (body.name.empty()) body.name = file.stem().string();
  return body;
}

void saveBodyDescription(const BodyDescription& body, const std::filesystem::path& file) {
  writeFileAtomically(file, jsonText(bodyToJson(body)));
}

const std::vector<std::string>& shapePresetNames() {
  static const std::vector<std::string> names = {"human", "alien", "hulk", "dwarf", "child"};
  return names;
}

BodyDescription loadShapePreset(const std::filesystem::path& resource_dir, const std::string& name) {
  if (std::ranges::find(shapePresetNames(), name) == shapePresetNames().end())
    throw InputError{{"shape", "preset", "a known name", "'" + name + "'" + didYouMean(name, shapePresetNames())}};
  return loadBodyDescription(resource_dir / "shapes" / (name + ".json"));
}

BodyDescription loadBody(const std::string& preset_or_file, const std::filesystem::path& resource_dir) {
  if (std::ranges::find(shapePresetNames(), preset_or_file) != shapePresetNames().end())
    return loadShapePreset(resource_dir, preset_or_file);
  if (!std::filesystem::exists(preset_or_file))
    throw InputError{{"shape", "", "a file or one of the presets",
                      "'" + preset_or_file + "'" + didYouMean(preset_or_file, shapePresetNames())}};
  return loadBodyDescription(preset_or_file);
}

}  // namespace sinew
