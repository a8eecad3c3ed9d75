#include "core/rom/edit/rom_edit_json.h"

#include <cmath>

#include "core/angle.h"
#include "core/file.h"

namespace sinew {
namespace {

/// Degrees that read back as the same radians.
double degrees(double rad) {
  double deg = rad / kRadPerDeg;
  const double rounded = std::round(deg * 1e6) / 1e6;
  if (rounded * kRadPerDeg == rad) return rounded;
  for (int i = 0; i < 8 && deg * kRadPerDeg != rad; ++i)
    deg = std::nextafter(deg, deg * kRadPerDeg < rad ? 1e9 : -1e9);
  return deg;
}

Json tiltToJson(const RomTilt& tilt) {
  Json json = Json::object();
  if (tilt.towards.empty())
    json["about"] = tilt.axis_J;
  else
    json["towards"] = tilt.towards;
  json["deg"] = degrees(tilt.angle_rad);
  return json;
}

RomTilt tiltFromJson(const JsonReader& json) {
  json.allowOnly({"towards", "about", "deg"});
  RomTilt tilt{.angle_rad = json["deg"].number() * kRadPerDeg};
  const auto towards = json.find("towards"), about = json.find("about");
  if (towards.has_value() == about.has_value()) json.fail("either towards or about");
  if (towards) {
    tilt.towards = towards->text();
    if (tilt.towards.empty()) towards->fail("the name of a direction");
  } else {
    const auto axis = about->numbers(3);
    tilt.axis_J = {axis[0], axis[1], axis[2]};
  }
  return tilt;
}

RomEdit editFromJson(const JsonReader& json, const Skeleton& skeleton) {
  json.allowOnly({"joint", "scale", "shift_deg", "cone", "tilt", "twist_scale", "twist_shift_deg"});
  RomEdit e{.joint = json["joint"].text()};
  const auto number = [&](const char* field, double& value, double unit) {
    if (const auto found = json.find(field)) value = found->number() * unit;
  };
  number("scale", e.range_factor, 1);
  number("shift_deg", e.shift_rad, kRadPerDeg);
  number("cone", e.cone_factor, 1);
  number("twist_scale", e.twist_factor, 1);
  number("twist_shift_deg", e.twist_shift_rad, kRadPerDeg);
  if (const auto tilt = json.find("tilt")) e.tilt = tiltFromJson(*tilt);
  checkRomEdits(skeleton, {e}, json.where() + ": " + json.path());
  return e;
}

}  // namespace

Json romEditsToJson(const RomEdits& edits) {
  Json list = Json::array();
  for (const RomEdit& e : edits) {
    Json json{{"joint", e.joint}};
    if (e.range_factor != 1) json["scale"] = e.range_factor;
    if (e.shift_rad != 0) json["shift_deg"] = degrees(e.shift_rad);
    if (e.cone_factor != 1) json["cone"] = e.cone_factor;
    if (e.tilt != RomTilt{}) json["tilt"] = tiltToJson(e.tilt);
    if (e.twist_factor != 1) json["twist_scale"] = e.twist_factor;
    if (e.twist_shift_rad != 0) json["twist_shift_deg"] = degrees(e.twist_shift_rad);
    list.push_back(json);
  }
  return list;
}

RomEdits romEditsFromJson(const JsonReader& document, const Skeleton& skeleton) {
  document.expectFormat("sinew.rom_edits", 1);
  document.allowOnly({"format", "version", "edits"});
  RomEdits edits;
  for (const JsonReader& json : document["edits"].items()) edits.push_back(editFromJson(json, skeleton));
  return edits;
}

RomEdits loadRomEdits(const std::filesystem::path& file, const Skeleton& skeleton) {
  const std::string where = file.filename().string();
  const Json document = parseJson(readFile(file), where);
  return romEditsFromJson(JsonReader{document, where}, skeleton);
}

void saveRomEdits(const RomEdits& edits, const std::filesystem::path& file) {
  writeFileAtomically(file,
                      jsonText({{"format", "sinew.rom_edits"}, {"version", 1}, {"edits", romEditsToJson(edits)}}));
}

}  // namespace sinew
