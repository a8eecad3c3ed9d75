#include "core/model/rom_preset.h"

#include <algorithm>

#include "core/angle.h"
#include "core/error.h"
#include "core/file.h"
#include "core/strict_json.h"
#include "core/text.h"

namespace sinew {
namespace {

void readTarget(const JsonReader& json, RomBound& bound) {
  const auto test = json.find("test");
  if (!test) return;
  bound.test = test->text();
  bound.target_deg = json["target_deg"].numberIn(-200, 200);
}

/// "min" or "max" of a range: {"deg": 120, "test": "hipflex_knee_flexed", "target_deg": 120, "source": ".."}.
RomBound endFrom(const JsonReader& json, const std::string& coordinate, int sense, const std::string& source) {
  json.allowOnly({"deg", "test", "target_deg", "source"});
  RomBound bound{.name = coordinate + (sense > 0 ? " max" : " min"), .terms = {{coordinate, double(sense)}}};
  bound.end_deg = sense * json["deg"].numberIn(-180, 180);
  readTarget(json, bound);
  const auto own = json.find("source");
  bound.source = own ? own->text() : source;
  return bound;
}

/// {"terms": {"hip_flexion": 1, "knee_flexion": -0.5}, "deg": 74, "test": .., "target_deg": .., "source": ".."}.
RomBound couplingFrom(const JsonReader& json) {
  json.allowOnly({"terms", "deg", "test", "target_deg", "source"});
  RomBound bound;
  for (const auto& [coordinate, factor] : json["terms"].members()) {
    bound.terms.push_back({coordinate, factor.numberIn(-100, 100)});
    const double f = bound.terms.back().factor;
    bound.name += bound.name.empty() ? (f < 0 ? "-" : "") : (f < 0 ? " - " : " + ");
    if (std::abs(f) != 1) bound.name += brief(std::abs(f)) + " ";
    bound.name += coordinate;
  }
  if (bound.terms.size() < 2) json["terms"].fail("at least two coordinates");
  if (std::abs(bound.terms.front().factor) != 1) json["terms"].fail("1 or -1 as the first factor");
  bound.end_deg = json["deg"].numberIn(-1000, 1000);
  readTarget(json, bound);
  bound.source = json["source"].text();
  return bound;
}

void checkCoordinates(const RomPreset& preset, const Skeleton& skeleton, const std::string& where) {
  for (const auto& bound : preset.bounds)
    for (const auto& term : bound.terms) {
      try {
        sidedCoordinate(skeleton, term.coordinate, 'r');
      } catch (const InputError& error) {
        throw InputError{where + ": " + bound.name + ": " + error.what()};
      }
    }
  for (const auto& c : skeleton.coordinates) {
    if (skeleton.joints[c.joint].type == JointType::Free) continue;
    for (const int sense : {1, -1})
      if (std::ranges::none_of(preset.bounds, [&](const RomBound& b) {
            return !b.isCoupling() && b.terms[0].factor == sense && b.terms[0].coordinate == withoutSide(c.name);
          }))
        throw InputError{{where, "ranges", "a range of " + std::string{withoutSide(c.name)}, "none"}};
  }
}

}  // namespace

std::vector<RomTarget> RomPreset::targets() const {
  std::vector<RomTarget> all;
  for (const RomBound& bound : bounds)
    if (!bound.test.empty() && std::ranges::none_of(all, [&](const RomTarget& t) { return t.test == bound.test; }))
      all.push_back({bound.test, bound.target_deg});
  all.insert(all.end(), more_targets.begin(), more_targets.end());
  return all;
}

const std::vector<std::string>& romPresetNames() {
  static const std::vector<std::string> names{"average-adult", "athlete"};
  return names;
}

RomPreset loadRomPreset(const std::filesystem::path& resource_dir, std::string_view name, const Skeleton& skeleton) {
  const auto& known = romPresetNames();
  if (std::ranges::find(known, name) == known.end())
    throw InputError{
        {"preset", "", "average-adult or athlete", "'" + std::string{name} + "'" + didYouMean(name, known)}};
  const auto file = resource_dir / "rom" / (std::string{name} + ".json");
  const Json document = parseJson(readFile(file), file.filename().string());
  const JsonReader root{document, file.filename().string()};
  root.expectFormat("sinew.rom_preset", 1);
  root.allowOnly({"format", "version", "name", "title", "note", "ranges", "couplings", "more_targets"});
  RomPreset preset{root["name"].text(), root["title"].text(), root["note"].text(), {}, {}};
  for (const auto& json : root["ranges"].items()) {
    json.allowOnly({"coordinate", "min", "max", "symmetric", "source"});
    const std::string coordinate = json["coordinate"].text(), source = json["source"].text();
    if (const auto symmetric =
            json.find("symmetric")) {  // of the midline: the same to either side, one test for both
      preset.bounds.push_back(endFrom(*symmetric, coordinate, 1, source));
      preset.bounds.push_back(preset.bounds.back());
      preset.bounds.back().name = coordinate + " min";
      preset.bounds.back().terms[0].factor = -1;
    } else {
      preset.bounds.push_back(endFrom(json["min"], coordinate, -1, source));
      preset.bounds.push_back(endFrom(json["max"], coordinate, 1, source));
    }
  }
  for (const auto& json : root["couplings"].items()) preset.bounds.push_back(couplingFrom(json));
  for (const auto& json : root["more_targets"].items()) {
    json.allowOnly({"test", "target_deg", "to_stops"});
    RomTarget target{.test = json["test"].text()};
    if (const auto to_stops = json.find("to_stops")) target.to_stops = to_stops->boolean();
    if (!target.to_stops) target.target_deg = json["target_deg"].numberIn(-200, 200);
    preset.more_targets.push_back(target);
  }
  checkCoordinates(preset, skeleton, file.filename().string());
  return preset;
}

int sidedCoordinate(const Skeleton& skeleton, const std::string& name, char side) {
  const std::string sided = name + "_" + side;
  for (int i = 0; i < skeleton.coordinateCount(); ++i)
    if (skeleton.coordinates[i].name == sided || skeleton.coordinates[i].name == name) return i;
  std::vector<std::string> known;
  for (const auto& c : skeleton.coordinates)
    if (!c.name.ends_with("_l")) known.emplace_back(withoutSide(c.name));
  throw InputError{"coordinate '" + name + "' does not exist" + didYouMean(name, known)};
}

SidedBound sidedBound(const Skeleton& skeleton, const RomBound& bound, char side) {
  SidedBound b{.limit_rad = bound.end_deg * kRadPerDeg};
  for (const auto& term : bound.terms)
    b.terms.emplace_back(sidedCoordinate(skeleton, term.coordinate, side), term.factor);
  return b;
}

std::vector<SidedBound> sidedBounds(const Skeleton& skeleton, const RomPreset& preset) {
  std::vector<SidedBound> sided;
  for (const auto& bound : preset.bounds) {
    sided.push_back(sidedBound(skeleton, bound, 'r'));
    const std::string& first = bound.terms[0].coordinate;
    const bool midline = skeleton.coordinates[sided.back().terms[0].first].name == first;
    if (!midline) sided.push_back(sidedBound(skeleton, bound, 'l'));
  }
  return sided;
}

void setStops(Skeleton& skeleton, const RomPreset& preset) {
  for (Joint& joint : skeleton.joints) joint.edited = {};
  for (const SidedBound& bound : sidedBounds(skeleton, preset)) {
    if (bound.terms.size() > 1) continue;
    const auto [index, sense] = bound.terms[0];
    (sense > 0 ? skeleton.coordinates[index].stop_max_rad : skeleton.coordinates[index].stop_min_rad) =
        sense * bound.limit_rad;
  }
}

}  // namespace sinew
