#include <algorithm>
#include <set>

#include "core/angle.h"
#include "core/skeleton/shape/population.h"
#include "core/skeleton/shape/shape_json.h"
#include "core/skeleton/skeleton.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kLeastFactor = 0.01, kGreatestFactor = 100;  // beyond it is a wrong unit
constexpr double kGreatestAge_years = 120;

/// "femur_r.torsion" -> "femur_r", "torsion".
std::pair<std::string, std::string> split(const std::string& field) {
  const auto dot = std::min(field.find('.'), field.size());
  return {field.substr(0, dot), dot < field.size() ? field.substr(dot + 1) : ""};
}

std::string bothSides(const std::string& field) {
  const auto [part, quantity] = split(field);
  return std::string{withoutSide(part)} + (quantity.empty() ? "" : "." + quantity);
}

/// A unit in such a file: what is added to the name, the unit in radians or metres, the bounds.
struct FileUnit {
  std::string suffix;
  double in_si, least, greatest;
};
/// The units that a quantity may be given in; the first is the one that is written.
const std::vector<FileUnit>& unitsOf(ShapeUnit unit) {
  static const std::vector<FileUnit> ratio = {{"", 1, kLeastShapeRatio, kGreatestShapeRatio}},
                                     angle = {{"_deg", kRadPerDeg, -kGreatestShapeAngle_rad, kGreatestShapeAngle_rad},
                                              {"_rad", 1, -kGreatestShapeAngle_rad, kGreatestShapeAngle_rad}},
                                     length = {{"_mm", 1e-3, -kGreatestShapeLength_m, kGreatestShapeLength_m},
                                               {"_m", 1, -kGreatestShapeLength_m, kGreatestShapeLength_m}};
  return unit == ShapeUnit::Angle ? angle : unit == ShapeUnit::Length ? length : ratio;
}

/// Name of a parameter in such a file: angles in degrees, lengths in millimetres.
std::string fileName(const std::string& parameter) {
  return parameter + unitsOf(shapeUnit(parameter)).front().suffix;
}

/// Every field of a part, as "femur.elongation", "femur_r.elongation", "trunk.mass"; for answers to a wrong one.
const std::vector<std::string>& fieldNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    const auto add = [&](const std::string& name) {
      if (std::ranges::find(list, name) == list.end()) list.push_back(name);
    };
    for (const auto& parameter : shapeParameterNames())
      for (const auto& name : {bothSides(fileName(parameter)), fileName(parameter)}) add(name);
    for (const auto& part : massParts())
      for (const char* quantity : {".mass", ".mass_ratio"}) add(part + quantity);
    return list;
  }();
  return names;
}

const std::vector<std::string>& partNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& field : fieldNames())
      if (const auto part = split(field).first; std::ranges::find(list, part) == list.end()) list.push_back(part);
    return list;
  }();
  return names;
}

/// Reads the fields one by one; what is said of one side or segment wins over what is said of both or of the trunk.
class BodyReader {
 public:
  explicit BodyReader(BodyDescription& body) : body_{body}, values_{toVector(body.shape)} {}

  void read(const std::string& field, const JsonReader& json) {
    const auto [part, quantity] = split(field);
    if (quantity == "mass" || quantity == "mass_ratio")
      readMass(part, quantity, json);
    else
      readParameter(part, quantity, json);
  }

  void finish() { body_.shape = shapeFromVector(values_); }

 private:
  void readParameter(const std::string& part, const std::string& quantity, const JsonReader& json) {
    const auto& known = shapeParameterNames();
    for (const ShapeUnit kind : {ShapeUnit::Ratio, ShapeUnit::Angle, ShapeUnit::Length})
      for (const FileUnit& unit : unitsOf(kind)) {
        if (!quantity.ends_with(unit.suffix)) continue;
        const std::string name = part + "." + quantity.substr(0, quantity.size() - unit.suffix.size());
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < known.size(); ++i)
          if ((known[i] == name || bothSides(known[i]) == name) && shapeUnit(known[i]) == kind) places.push_back(i);
        if (places.empty()) continue;
        set(places, name, json.numberIn(unit.least / unit.in_si, unit.greatest / unit.in_si) * unit.in_si, json);
        return;
      }
    unknown(json);
  }

  void set(const std::vector<std::size_t>& places, const std::string& name, double value, const JsonReader& json) {
    const auto& known = shapeParameterNames();
    once(name, json);
    for (const std::size_t i : places)
      if (places.size() == 1 || !given_.contains(known[i])) values_[i] = value;
  }

  void readMass(const std::string& part, const std::string& quantity, const JsonReader& json) {
    const auto segments = segmentsOfPart(part);
    if (segments.empty()) unknown(json);
    once(part + ".mass", json);
    const double value = json.numberIn(kLeastFactor, kGreatestFactor);
    for (const auto& segment : segments) {
      if (segments.size() > 1 && saidNearer(segment, segments.size())) continue;
      mass_breadth_[segment] = segments.size();
      body_.physics.mass_factors.erase(segment);
      body_.physics.mass_ratios.erase(segment);
      (quantity == "mass" ? body_.physics.mass_factors : body_.physics.mass_ratios)[segment] = value;
    }
  }

  bool saidNearer(const std::string& segment, std::size_t breadth) const {
    const auto said = mass_breadth_.find(segment);
    return said != mass_breadth_.end() && said->second < breadth;
  }

  /// The same thing said twice, flat and nested or in two units, is a mistake that nobody should have to find.
  void once(const std::string& name, const JsonReader& json) {
    if (!given_.insert(name).second) json.fail("one value of " + name, "a second one");
  }

  [[noreturn]] static void unknown(const JsonReader& json) {
    json.fail("a field of a body", "'" + json.path() + "'" + didYouMean(json.path(), fieldNames()));
  }

  BodyDescription& body_;
  std::vector<double> values_;
  std::set<std::string> given_;
  std::map<std::string, std::size_t> mass_breadth_;  ///< of the part that said it, in segments
};

std::map<std::string, double> factorsFromJson(const JsonReader& json) {
  std::map<std::string, double> factors;
  for (const auto& [name, value] : json.members()) factors[name] = value.numberIn(kLeastFactor, kGreatestFactor);
  return factors;
}

std::map<std::string, std::string> sourcesFromJson(const JsonReader& json) {
  std::map<std::string, std::string> sources;
  for (const auto& [name, value] : json.members()) {
    const bool known = std::ranges::count(fieldNames(), name) || std::ranges::count(partNames(), name) ||
                       name == "strength" || name == "age_years" || name == "all";
    if (!known) value.fail("a field or part of a body, or 'all'", "'" + name + "'" + didYouMean(name, fieldNames()));
    sources[name] = value.text();
  }
  return sources;
}

/// Writes value into json[part][quantity].
void put(Json& json, const std::string& field, double value) {
  const auto [part, quantity] = split(field);
  json[part][quantity] = value;
}

/// The parameter of the other side; its own name on the midline.
std::string otherSide(const std::string& parameter) {
  const auto [part, quantity] = split(parameter);
  if (part == withoutSide(part)) return parameter;
  return std::string{withoutSide(part)} + (part.ends_with("_r") ? "_l." : "_r.") + quantity;
}

void putShape(Json& json, const ShapeParameters& shape) {
  const auto& names = shapeParameterNames();
  const auto values = toVector(shape), same = toVector(ShapeParameters{});
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (values[i] == same[i]) continue;
    const auto twin = std::size_t(std::ranges::find(names, otherSide(names[i])) - names.begin());
    const bool alike = values[twin] == values[i];
    if (alike && twin < i) continue;  // the right side said it for both
    put(json, fileName(alike ? bothSides(names[i]) : names[i]),
        values[i] / unitsOf(shapeUnit(names[i])).front().in_si);
  }
}

void putMasses(Json& json, const std::map<std::string, double>& factors, const std::string& quantity) {
  std::set<std::string> written;
  for (const auto& part : massParts()) {  // the widest parts first
    const auto segments = segmentsOfPart(part);
    const auto first = factors.find(segments.front());
    if (first == factors.end()) continue;
    const bool alike = std::ranges::all_of(segments, [&](const std::string& s) {
      const auto at = factors.find(s);
      return at != factors.end() && at->second == first->second && !written.contains(s);
    });
    if (!alike) continue;
    put(json, part + quantity, first->second);
    written.insert(segments.begin(), segments.end());
  }
}

}  // namespace

const std::vector<std::string>& massParts() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list = {"pelvis", "trunk", "lumbar", "thorax", "neck", "head"};
    for (const std::string part : {"scapula", "femur", "tibia", "foot", "humerus", "ulna", "hand"})
      for (const char* side : {"", "_r", "_l"}) list.push_back(part + side);
    return list;
  }();
  return names;
}

std::vector<std::string> segmentsOfPart(const std::string& part) {
  if (std::ranges::find(massParts(), part) == massParts().end()) return {};
  if (part == "trunk") return {"lumbar", "thorax", "scapula_r", "scapula_l"};
  const bool paired = std::ranges::find(massParts(), part + "_r") != massParts().end();
  if (paired) return {part + "_r", part + "_l"};
  return {part};
}

BodyDescription bodyFromJson(const JsonReader& json) {
  BodyDescription body;
  body.name.clear();
  BodyReader reader{body};
  const std::vector<std::string> plain = {"format", "version", "name", "about", "age_years", "strength", "sources"};
  if (json.find("format") || json.find("version")) json.expectFormat("sinew.shape", 1);
  for (const auto& [name, value] : json.members()) {
    if (name == "name")
      body.name = value.text();
    else if (name == "about")
      body.about = value.text();
    else if (name == "age_years")
      body.physics.age_years = value.numberIn(0, kGreatestAge_years);
    else if (name == "strength")
      body.physics.strength_factors = factorsFromJson(value);
    else if (name == "sources")
      body.sources = sourcesFromJson(value);
    else if (name.find('.') != std::string::npos)
      reader.read(name, value);
    else if (std::ranges::count(partNames(), name))
      for (const auto& [quantity, entry] : value.members()) reader.read(name + "." + quantity, entry);
    else if (!std::ranges::count(plain, name)) {
      std::vector<std::string> known = partNames();
      known.insert(known.end(), plain.begin(), plain.end());
      value.fail("a part of a body", "'" + name + "'" + didYouMean(name, known));
    }
  }
  reader.finish();
  return body;
}

Json bodyToJson(const BodyDescription& body) {
  Json json{{"format", "sinew.shape"}, {"version", 1}, {"name", body.name}};
  if (!body.about.empty()) json["about"] = body.about;
  if (body.physics.age_years) json["age_years"] = *body.physics.age_years;
  putShape(json, body.shape);
  putMasses(json, body.physics.mass_factors, ".mass");
  putMasses(json, body.physics.mass_ratios, ".mass_ratio");
  if (!body.physics.strength_factors.empty()) json["strength"] = body.physics.strength_factors;
  if (!body.sources.empty()) json["sources"] = body.sources;
  return json;
}

Json physicsFactorsToJson(const PhysicsFactors& factors) {
  Json json{{"mass_factors", factors.mass_factors},
            {"mass_ratios", factors.mass_ratios},
            {"strength_factors", factors.strength_factors}};
  if (factors.age_years) json["age_years"] = *factors.age_years;
  return json;
}

PhysicsFactors physicsFactorsFromJson(const JsonReader& json) {
  json.allowOnly({"mass_factors", "mass_ratios", "strength_factors", "age_years"});
  PhysicsFactors factors{factorsFromJson(json["mass_factors"]), factorsFromJson(json["mass_ratios"]),
                         factorsFromJson(json["strength_factors"]), std::nullopt};
  if (const auto age = json.find("age_years")) factors.age_years = age->numberIn(0, kGreatestAge_years);
  for (const auto& [place, masses] :
       {std::pair{"mass_factors", factors.mass_factors}, std::pair{"mass_ratios", factors.mass_ratios}})
    for (const auto& [segment, factor] : masses)
      if (segmentsOfPart(segment) != std::vector{segment})
        json[place].fail("segments that carry mass", "'" + segment + "'" + didYouMean(segment, massParts()));
  return factors;
}

}  // namespace sinew
