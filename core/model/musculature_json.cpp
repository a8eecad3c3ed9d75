#include "core/model/musculature_json.h"

#include <cmath>
#include <set>

#include "core/model/skeleton_json.h"

namespace sinew {
namespace {

const char* nameOf(PathPointRole role) {
  switch (role) {
    case PathPointRole::Origin:
      return "origin";
    case PathPointRole::Via:
      return "via";
    case PathPointRole::Insertion:
      return "insertion";
  }
  return "";
}

PathPoint pointFromJson(const JsonReader& json, const Skeleton& skeleton) {
  json.allowOnly({"role", "bone", "site", "anchors"});
  PathPoint point;
  const std::string role = json["role"].oneOf({"origin", "via", "insertion"});
  point.role = role == "origin" ? PathPointRole::Origin
               : role == "via"  ? PathPointRole::Via
                                : PathPointRole::Insertion;
  point.bone = json["bone"].text();
  point.site = json["site"].text();
  double sum = 0;
  for (const auto& a : json["anchors"].items()) {
    a.allowOnly({"segment", "weight", "position_m"});
    Anchor anchor;
    anchor.segment = namedIndex(a["segment"], [&](const std::string& n) { return skeleton.segmentIndex(n); });
    anchor.weight = a["weight"].numberIn(0, 1);
    anchor.p_B = vectorFromJson(a["position_m"]);
    sum += anchor.weight;
    point.anchors.push_back(anchor);
  }
  if (std::abs(sum - 1) > 1e-9) json["anchors"].fail("weights with sum 1", std::to_string(sum));
  return point;
}

/// The figures that differ from the published ones; null if none do.
Json curvesToJson(const HillParameters& curves) {
  Json json;
  for (const HillField& field : hillFields())
    if (curves.*field.value != HillParameters{}.*field.value) json[field.name] = curves.*field.value;
  return json;
}

HillParameters curvesFromJson(const JsonReader& json) {
  HillParameters curves;
  for (const auto& [name, value] : json.members()) {
    const HillField& field = hillField(name, json.where() + ": " + json.path());
    curves.*field.value = value.numberIn(field.low, field.high);
  }
  return curves;
}

MusculotendonUnit unitFromJson(const JsonReader& json, const Skeleton& skeleton) {
  json.allowOnly({"name", "group", "max_isometric_force_N", "optimal_fiber_length_m", "tendon_slack_length_m",
                  "pennation_angle_at_optimal_rad", "curves", "source", "path"});
  MusculotendonUnit unit;
  unit.name = json["name"].text();
  unit.group = json["group"].text();
  unit.max_isometric_force_N = json["max_isometric_force_N"].positive();
  unit.optimal_fiber_length_m = json["optimal_fiber_length_m"].positive();
  unit.tendon_slack_length_m = json["tendon_slack_length_m"].positive();
  unit.pennation_angle_at_optimal_rad = json["pennation_angle_at_optimal_rad"].numberIn(0, 1.5);
  if (const auto curves = json.find("curves")) unit.curves = curvesFromJson(*curves);
  unit.source = json["source"].text();
  for (const auto& point : json["path"].items()) unit.path.push_back(pointFromJson(point, skeleton));
  if (unit.path.size() < 2) json["path"].fail("two points or more", std::to_string(unit.path.size()));
  return unit;
}

}  // namespace

Json musculatureToJson(const Musculature& musculature, const Skeleton& skeleton) {
  Json units = Json::array();
  for (const auto& unit : musculature.units) {
    Json path = Json::array();
    for (const PathPoint& point : unit.path) {
      Json anchors = Json::array();
      for (const Anchor& a : point.anchors)
        anchors.push_back({{"segment", skeleton.segments[a.segment].name},
                           {"weight", a.weight},
                           {"position_m", vectorToJson(a.p_B)}});
      path.push_back(
          {{"role", nameOf(point.role)}, {"bone", point.bone}, {"site", point.site}, {"anchors", anchors}});
    }
    Json json{{"name", unit.name},
              {"group", unit.group},
              {"max_isometric_force_N", unit.max_isometric_force_N},
              {"optimal_fiber_length_m", unit.optimal_fiber_length_m},
              {"tendon_slack_length_m", unit.tendon_slack_length_m},
              {"pennation_angle_at_optimal_rad", unit.pennation_angle_at_optimal_rad},
              {"source", unit.source},
              {"path", path}};
    if (const Json curves = curvesToJson(unit.curves); !curves.is_null()) json["curves"] = curves;
    units.push_back(std::move(json));
  }
  return units;
}

Musculature musculatureFromJson(const JsonReader& json, const Skeleton& skeleton) {
  Musculature musculature;
  std::set<std::string> names;
  for (const auto& item : json.items()) {
    musculature.units.push_back(unitFromJson(item, skeleton));
    const std::string& name = musculature.units.back().name;
    if (!names.insert(name).second) item["name"].fail("a name of its own", "'" + name + "' twice");
  }
  return musculature;
}

}  // namespace sinew
