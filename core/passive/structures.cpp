#include "core/passive/structures.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/file.h"
#include "core/strict_json.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kLargest_Nm = 1000, kLargestRate_per_rad = 500;

EndStructures endFrom(const JsonReader& json, std::string_view preset) {
  json.allowOnly({"end_Nm", "end_Nm_of", "rate_per_rad", "source", "verified"});
  EndStructures end;
  const auto others = json.find("end_Nm_of");
  const auto own = others ? others->find(preset) : std::nullopt;
  const JsonReader moment = own ? *own : json["end_Nm"];
  end.end_Nm = moment.positive();
  if (end.end_Nm > kLargest_Nm) moment.fail("at most 1000 N m");
  end.rate_per_rad = json["rate_per_rad"].positive();
  if (end.rate_per_rad > kLargestRate_per_rad) json["rate_per_rad"].fail("at most 500 per radian");
  end.source = json["source"].text();
  end.verified = json["verified"].boolean();
  return end;
}

bool known(const Skeleton& skeleton, const std::string& coordinate) {
  return std::ranges::any_of(skeleton.coordinates,
                             [&](const Coordinate& c) { return withoutSide(c.name) == coordinate; });
}

void requireKnown(const JsonReader& name, const Skeleton& skeleton) {
  if (known(skeleton, name.text())) return;
  std::vector<std::string> names;
  for (const Coordinate& c : skeleton.coordinates) names.emplace_back(withoutSide(c.name));
  name.fail("a coordinate without side", "'" + name.text() + "'" + didYouMean(name.text(), names));
}

/// "min" and "max", or "both" ends alike.
CoordinateStructures coordinateFrom(const JsonReader& json, const Skeleton& skeleton, std::string_view preset) {
  json.allowOnly({"coordinate", "min", "max", "both"});
  requireKnown(json["coordinate"], skeleton);
  CoordinateStructures c{json["coordinate"].text(), {}, {}};
  if (const auto both = json.find("both")) {
    json.allowOnly({"coordinate", "both"});
    c.lower = c.upper = endFrom(*both, preset);
  } else {
    c.lower = endFrom(json["min"], preset);
    c.upper = endFrom(json["max"], preset);
  }
  return c;
}

LaxityByAge laxityFrom(const JsonReader& json, const Skeleton& skeleton) {
  json.allowOnly({"coordinate", "end", "age_years", "wider_deg", "source", "verified"});
  requireKnown(json["coordinate"], skeleton);
  LaxityByAge row;
  row.coordinate = json["coordinate"].text();
  row.upper = json["end"].oneOf({"min", "max"}) == "max";
  row.age_years = json["age_years"].numbers();
  row.shift_rad = json["wider_deg"].numbers(row.age_years.size());
  if (row.age_years.empty() || !std::ranges::is_sorted(row.age_years)) json["age_years"].fail("ages in their order");
  for (double& shift : row.shift_rad) {
    if (shift < 0) json["wider_deg"].fail("a range that is wider than an adult's, or 0");
    shift *= kRadPerDeg;
  }
  row.source = json["source"].text();
  json["verified"].boolean();
  return row;
}

const CoordinateStructures* structuresOf(const PassiveStructures& structures, const std::string& coordinate) {
  const auto found =
      std::ranges::find(structures.coordinates, withoutSide(coordinate), &CoordinateStructures::coordinate);
  return found == structures.coordinates.end() ? nullptr : &*found;
}

}  // namespace

double LaxityByAge::at(double age) const {
  const auto next = std::ranges::upper_bound(age_years, age);
  if (next == age_years.begin()) return shift_rad.front();
  if (next == age_years.end()) return shift_rad.back();
  const auto i = static_cast<std::size_t>(next - age_years.begin());
  return std::lerp(shift_rad[i - 1], shift_rad[i], (age - age_years[i - 1]) / (age_years[i] - age_years[i - 1]));
}

PassiveStructures loadPassiveStructures(const std::filesystem::path& resource_dir, const Skeleton& skeleton,
                                        std::string_view preset) {
  const auto file = resource_dir / "skeleton" / "passive_moments.json";
  const Json document = parseJson(readFile(file), file.filename().string());
  const JsonReader root{document, file.filename().string()};
  root.expectFormat("sinew.passive_moments", 1);
  root.allowOnly({"format", "version", "note", "coordinates", "laxity"});
  PassiveStructures result;
  for (const auto& json : root["coordinates"].items()) {
    result.coordinates.push_back(coordinateFrom(json, skeleton, preset));
    const std::string& name = result.coordinates.back().coordinate;
    if (std::ranges::count(result.coordinates, name, &CoordinateStructures::coordinate) > 1)
      json["coordinate"].fail("one entry a coordinate", "'" + name + "' twice");
  }
  for (const Joint& joint : skeleton.joints)
    for (int i = 0; joint.type != JointType::Free && i < joint.coordinate_count; ++i) {
      const std::string& name = skeleton.coordinates[joint.first_coordinate + i].name;
      if (!structuresOf(result, name)) root["coordinates"].fail("an entry for '" + name + "'", "none");
    }
  for (const auto& json : root["laxity"].items()) result.laxity.push_back(laxityFrom(json, skeleton));
  return result;
}

PassiveMoments passiveMomentsAtStops(const PassiveStructures& structures, const Skeleton& skeleton) {
  PassiveMoments moments(skeleton.coordinates.size());
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Coordinate& c = skeleton.coordinates[i];
    const CoordinateStructures* s = structuresOf(structures, c.name);
    if (skeleton.joints[std::size_t(c.joint)].type == JointType::Free || !s) continue;
    moments[i] = {.upper_Nm = s->upper.end_Nm,
                  .upper_rate_per_rad = s->upper.rate_per_rad,
                  .lower_Nm = s->lower.end_Nm,
                  .lower_rate_per_rad = s->lower.rate_per_rad};
  }
  return movedToStops(std::move(moments), skeleton);
}

PassiveMoments movedToStops(PassiveMoments moments, const Skeleton& skeleton) {
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (moments[i].upper_Nm > 0) moments[i].upper_rad = skeleton.coordinates[i].stop_max_rad;
    if (moments[i].lower_Nm > 0) moments[i].lower_rad = skeleton.coordinates[i].stop_min_rad;
  }
  return moments;
}

PassiveMoments scaledStructures(const PassiveMoments& of_reference, const Skeleton& reference, const Skeleton& body) {
  PassiveMoments moments = of_reference;
  const double scale = bodyMass_kg(body) / bodyMass_kg(reference);
  for (PassiveMoment& m : moments) m.upper_Nm *= scale, m.lower_Nm *= scale;
  return movedToStops(std::move(moments), body);
}

void widenStops(Skeleton& skeleton, const Laxity& laxity, double age_years) {
  for (Coordinate& c : skeleton.coordinates) {
    for (const LaxityByAge& row : laxity) {
      if (row.coordinate != withoutSide(c.name)) continue;
      const double shift_rad = row.at(age_years);
      if (row.upper)
        c.stop_max_rad = std::max(c.stop_max_rad, std::min(c.stop_max_rad + shift_rad, c.athlete_max_rad));
      else
        c.stop_min_rad = std::min(c.stop_min_rad, std::max(c.stop_min_rad - shift_rad, c.athlete_min_rad));
    }
  }
}

double bodyMass_kg(const Skeleton& skeleton) {
  double mass_kg = 0;
  for (const Segment& segment : skeleton.segments) mass_kg += segment.mass_kg;
  return mass_kg;
}

}  // namespace sinew
