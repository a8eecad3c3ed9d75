#include "core/skeleton/fit/landmark_protocol.h"

#include <algorithm>

#include "core/file.h"
#include "core/strict_json.h"

namespace sinew {
namespace {

std::string capitalized(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::vector<int> viewsFrom(const JsonReader& json) {
  std::vector<int> views;
  for (const auto& view : json.items()) views.push_back(view.integer(1, 2) - 1);
  if (views.empty()) json.fail("at least one view");
  return views;
}

/// `side`: "right", "left" or "" for a group of the midline.
void addGroup(const JsonReader& group, const std::string& side, double pick_sd_mm,
              std::vector<ProtocolLandmark>& landmarks) {
  const auto add = [&](const JsonReader& entry, const std::string& of_side) {
    entry.allowOnly({"name", "title", "views", "paired", "hint", "definition_sd_mm", "definition_source"});
    const auto sd_mm = entry["definition_sd_mm"].numbers(3);
    if (*std::ranges::min_element(sd_mm) < 0) entry["definition_sd_mm"].fail("three numbers >= 0 [mm]");
    const std::string suffix = of_side.empty() ? "" : of_side == "right" ? "_r" : "_l";
    const std::string title = of_side.empty() ? entry["title"].text() : of_side + " " + entry["title"].text();
    const std::string group_title = side.empty() ? group["title"].text() : side + " " + group["title"].text();
    landmarks.push_back({entry["name"].text() + suffix,
                         capitalized(title),
                         capitalized(group_title),
                         viewsFrom(entry["views"]),
                         entry["hint"].text(),
                         pick_sd_mm,
                         {sd_mm[0], sd_mm[1], sd_mm[2]},
                         entry["definition_source"].text()});
  };
  for (const auto& entry : group["landmarks"].items()) {
    const auto paired = entry.find("paired");
    if (!side.empty()) {
      add(entry, side);
    } else if (paired && paired->boolean()) {
      add(entry, "right");
      add(entry, "left");
    } else {
      add(entry, "");
    }
  }
}

}  // namespace

std::vector<ProtocolLandmark> loadLandmarkProtocol(const std::filesystem::path& resource_dir) {
  const auto file = resource_dir / "clinical" / "landmark_protocol.json";
  const Json document = parseJson(readFile(file), file.string());
  const JsonReader root{document, file.string()};
  root.expectFormat("sinew.landmark_protocol", 1);
  root.allowOnly({"format", "version", "about", "pick_sd_mm", "pick_source", "groups"});
  const double pick_sd_mm = root["pick_sd_mm"].positive();
  root["pick_source"].text();
  std::vector<ProtocolLandmark> landmarks;
  const auto groups = root["groups"].items();
  for (const auto& group : groups) {
    group.allowOnly({"title", "sided", "landmarks"});
    if (!group["sided"].boolean()) addGroup(group, "", pick_sd_mm, landmarks);
  }
  for (const char* side : {"right", "left"})
    for (const auto& group : groups)
      if (group["sided"].boolean()) addGroup(group, side, pick_sd_mm, landmarks);
  return landmarks;
}

std::vector<DefinitionError> definitionErrors(std::span<const ProtocolLandmark> protocol) {
  constexpr double kMm_m = 1e-3;
  std::vector<DefinitionError> errors;
  for (const auto& landmark : protocol)
    errors.push_back({landmark.name, (kMm_m * landmark.definition_sd_mm).cwiseAbs2().asDiagonal()});
  return errors;
}

}  // namespace sinew
