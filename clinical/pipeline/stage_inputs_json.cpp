#include "clinical/pipeline/stage_inputs_json.h"

namespace sinew {

std::string inputText(const Json& inputs) {
  return inputs.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json imageInputs(const std::vector<CaseImage>& images) {
  Json list = Json::array();
  for (const auto& image : images)
    list.push_back(Json::array({image.file.sha256, numberOrNull(image.declared_spacing_mm)}));
  return list;
}

Json sightingInputs(const std::vector<Sighting>& sightings) {
  Json list = Json::array();
  for (const auto& s : sightings) list.push_back(Json::array({s.name, s.view, s.uv_px.x(), s.uv_px.y(), s.sigma_px}));
  return list;
}

Json fileInput(const std::optional<FileReference>& file) {
  return file ? Json(file->sha256) : Json(nullptr);
}

}  // namespace sinew
