#include "core/foreign/foreign_json.h"

#include <algorithm>
#include <fstream>

#include "core/file.h"
#include "core/io/osim_reader.h"
#include "core/model/skeleton_json.h"

namespace sinew {
namespace {

Json toJson(const Eigen::Matrix3d& m) {
  return {vectorToJson(m.row(0)), vectorToJson(m.row(1)), vectorToJson(m.row(2))};
}
Eigen::Matrix3d matrixFromJson(const JsonReader& json) {
  const auto rows = json.items(3);
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) m.row(i) = vectorFromJson(rows[static_cast<std::size_t>(i)]);
  return m;
}

Json toJson(const RigidTransform& X) {
  return {{"position_m", vectorToJson(X.translation())}, {"rotation", toJson(X.linear())}};
}
RigidTransform poseFromJson(const JsonReader& json) {
  json.allowOnly({"position_m", "rotation"});
  RigidTransform X = RigidTransform::Identity();
  X.translation() = vectorFromJson(json["position_m"]);
  X.linear() = matrixFromJson(json["rotation"]);
  constexpr double kRotation = 1e-6;
  if (!X.linear().isUnitary(kRotation) || X.linear().determinant() < 0)
    json["rotation"].fail("a rotation matrix", "another matrix");
  return X;
}

const char* nameOf(ScalarFunction::Kind kind) {
  switch (kind) {
    case ScalarFunction::Kind::Constant:
      return "constant";
    case ScalarFunction::Kind::Polynomial:
      return "polynomial";
    case ScalarFunction::Kind::PiecewiseLinear:
      return "piecewise_linear";
    case ScalarFunction::Kind::SimmSpline:
      return "simm_spline";
  }
  return "";
}

Json toJson(const ScalarFunction& f) {
  if (f.x().empty()) return {{"kind", nameOf(f.kind())}, {"coefficients", f.coefficients()}};
  return {{"kind", nameOf(f.kind())}, {"x", f.x()}, {"y", f.y()}};
}
ScalarFunction functionFromJson(const JsonReader& json) {
  const std::string kind = json["kind"].oneOf({"constant", "polynomial", "piecewise_linear", "simm_spline"});
  if (kind == "constant" || kind == "polynomial") {
    const auto c = json["coefficients"].numbers();
    if (c.empty() || (kind == "constant" && c.size() > 1))
      json["coefficients"].fail("coefficients", "none or too many");
    return kind == "constant" ? ScalarFunction::constant(c[0]) : ScalarFunction::polynomial(c);
  }
  const auto x = json["x"].numbers();
  const auto y = json["y"].numbers(x.size());
  if (x.empty() || std::ranges::adjacent_find(x, std::greater_equal{}) != x.end())
    json["x"].fail("knots that increase", "none, or some that do not");
  return kind == "simm_spline" ? ScalarFunction::simmSpline(x, y) : ScalarFunction::piecewiseLinear(x, y);
}

/// Writes and reads the names of bodies and coordinates for their indices.
class Names {
 public:
  explicit Names(const ForeignModel& model) : model_{model} {}

  std::string body(int i) const { return i < 0 ? "ground" : model_.bodies[static_cast<std::size_t>(i)].name; }
  std::string coordinate(int i) const { return model_.coordinates[static_cast<std::size_t>(i)].name; }

  int body(const JsonReader& json) const {
    if (json.text() == "ground") return -1;
    const auto found = std::ranges::find(model_.bodies, json.text(), &Segment::name);
    if (found == model_.bodies.end()) json.fail("a body of the model");
    return static_cast<int>(found - model_.bodies.begin());
  }
  int coordinate(const JsonReader& json) const {
    return namedIndex(json, [&](const std::string& name) { return model_.coordinateIndex(name); });
  }

  Json function(const CoordinateFunction& f) const {
    Json terms = Json::array();
    for (const auto& t : f.terms)
      terms.push_back({{"coordinate", coordinate(t.coordinate)}, {"function", toJson(t.function)}});
    return {{"constant", f.constant}, {"terms", terms}};
  }
  CoordinateFunction function(const JsonReader& json) const {
    CoordinateFunction f{json["constant"].number(), {}};
    for (const auto& t : json["terms"].items())
      f.terms.push_back({coordinate(t["coordinate"]), functionFromJson(t["function"])});
    return f;
  }

 private:
  const ForeignModel& model_;
};

class Reader {
 public:
  explicit Reader(const JsonReader& json) : json_{json}, names_{model_} {}

  ForeignModel read() {
    json_.expectFormat("sinew.foreign_model", 1);
    json_.allowOnly({"format", "version", "name", "source", "credits", "gravity_m_s2", "bodies", "coordinates",
                     "joints", "couplings", "wrap_objects", "muscles", "warnings"});
    model_.name = json_["name"].text();
    model_.source = json_["source"].text();
    model_.credits = json_["credits"].text();
    model_.gravity_W_m_s2 = vectorFromJson(json_["gravity_m_s2"]);
    for (const auto& b : json_["bodies"].items()) body(b);
    for (const auto& c : json_["coordinates"].items()) coordinate(c);
    for (const auto& j : json_["joints"].items()) joint(j);
    for (const auto& c : json_["couplings"].items())
      model_.couplings.push_back({c["name"].text(), names_.coordinate(c["dependent"]), names_.function(c["value"])});
    for (const auto& w : json_["wrap_objects"].items()) wrapObject(w);
    for (const auto& m : json_["muscles"].items()) muscle(m);
    model_.warnings = warningsFromJson(json_["warnings"]);
    return std::move(model_);
  }

 private:
  void body(const JsonReader& json) {
    Segment b;
    b.name = json["name"].text();
    b.mass_kg = json["mass_kg"].number();
    b.p_BCom = vectorFromJson(json["centre_of_mass_m"]);
    b.inertia_B_kgm2 = matrixFromJson(json["inertia_kgm2"]);
    model_.bodies.push_back(b);
  }

  void coordinate(const JsonReader& json) {
    const auto range = json["range"].numbers(2);
    model_.coordinates.push_back({json["name"].text(), json["translational"].boolean(), json["default"].number(),
                                  range[0], range[1], json["clamped"].boolean(), json["locked"].boolean()});
  }

  std::array<ForeignAxis, 3> axes(const JsonReader& json) const {
    const auto items = json.items(3);
    std::array<ForeignAxis, 3> axes;
    for (std::size_t i = 0; i < 3; ++i)
      axes[i] = {vectorFromJson(items[i]["axis"]), names_.function(items[i]["amount"])};
    return axes;
  }

  void joint(const JsonReader& json) {
    ForeignJoint j;
    j.name = json["name"].text();
    j.kind = json["kind"].text();
    j.parent = names_.body(json["parent"]);
    j.child = names_.body(json["child"]);
    j.X_PF = poseFromJson(json["frame_on_parent"]);
    j.X_BM = poseFromJson(json["frame_on_child"]);
    j.turns = axes(json["turns"]);
    j.shifts = axes(json["shifts"]);
    j.ellipsoid_radii_m = vectorFromJson(json["ellipsoid_radii_m"]);
    j.towards_parent = json["towards_parent"].boolean();
    for (const auto& c : json["coordinates"].items()) j.coordinates.push_back(names_.coordinate(c));
    const int outer = j.towards_parent ? j.parent : j.child, inner = j.towards_parent ? j.child : j.parent;
    if (outer < 0) json.fail("a joint that moves a body", "one that moves the ground");
    model_.bodies[static_cast<std::size_t>(outer)].parent = inner;
    model_.joints.push_back(std::move(j));
  }

  void wrapObject(const JsonReader& json) {
    WrapObject w;
    w.name = json["name"].text();
    w.body = names_.body(json["body"]);
    w.X_BO = poseFromJson(json["pose"]);
    w.shape =
        json["shape"].oneOf({"cylinder", "ellipsoid"}) == "cylinder" ? WrapShape::Cylinder : WrapShape::Ellipsoid;
    w.radii_m = vectorFromJson(json["radii_m"]);
    if (!(w.radii_m.minCoeff() > 0)) json["radii_m"].fail("numbers > 0");
    w.side_axis = json["side_axis"].integer(0, 2);
    w.side_sign = json["side_sign"].integer(-1, 1);
    model_.wrap_objects.push_back(w);
  }

  void muscle(const JsonReader& json) {
    MusculotendonUnit unit;
    unit.name = json["name"].text();
    unit.source = model_.source;
    unit.max_isometric_force_N = json["max_isometric_force_N"].positive();
    unit.optimal_fiber_length_m = json["optimal_fiber_length_m"].positive();
    unit.tendon_slack_length_m = json["tendon_slack_length_m"].positive();
    unit.pennation_angle_at_optimal_rad = json["pennation_angle_at_optimal_rad"].numberIn(0, 1.5);
    model_.musculature.units.push_back(unit);
    model_.muscle_kinds.push_back(json["kind"].text());
    ForeignPath path;
    for (const auto& p : json["points"].items()) path.points.push_back(point(p));
    if (path.points.size() < 2) json["points"].fail("two points or more", std::to_string(path.points.size()));
    const int points = static_cast<int>(path.points.size());
    for (const auto& w : json["wraps"].items()) {
      const auto object = w["object"];
      const auto found = std::ranges::find(model_.wrap_objects, object.text(), &WrapObject::name);
      if (found == model_.wrap_objects.end()) object.fail("a wrap object of the model");
      path.wraps.push_back({static_cast<int>(found - model_.wrap_objects.begin()),
                            w["first_point"].integer(-1, points - 1), w["last_point"].integer(-1, points - 1)});
    }
    model_.paths.push_back(std::move(path));
  }

  ForeignPathPoint point(const JsonReader& json) const {
    ForeignPathPoint p;
    p.name = json["name"].text();
    p.body = names_.body(json["body"]);
    if (const auto frame = json.find("frame")) p.X_BF = poseFromJson(*frame);
    if (const auto moving = json.find("moving_location_m")) {
      const auto location = moving->items(3);
      for (std::size_t i = 0; i < 3; ++i) p.p_F[i] = names_.function(location[i]);
    } else {
      const Eigen::Vector3d location = vectorFromJson(json["location_m"]);
      for (std::size_t i = 0; i < 3; ++i) p.p_F[i].constant = location[static_cast<Eigen::Index>(i)];
    }
    if (const auto condition = json.find("while")) {
      const auto range = (*condition)["range"].numbers(2);
      p.condition = ForeignPathPoint::Condition{names_.coordinate((*condition)["coordinate"]), range[0], range[1]};
    }
    return p;
  }

  const JsonReader& json_;
  ForeignModel model_;
  Names names_;
};

Json axesJson(const Names& names, const std::array<ForeignAxis, 3>& axes) {
  Json list = Json::array();
  for (const auto& a : axes) list.push_back({{"axis", vectorToJson(a.axis)}, {"amount", names.function(a.amount)}});
  return list;
}

Json jointJson(const Names& names, const ForeignJoint& j) {
  Json coordinates = Json::array();
  for (const int c : j.coordinates) coordinates.push_back(names.coordinate(c));
  return {{"name", j.name},
          {"kind", j.kind},
          {"parent", names.body(j.parent)},
          {"child", names.body(j.child)},
          {"frame_on_parent", toJson(j.X_PF)},
          {"frame_on_child", toJson(j.X_BM)},
          {"turns", axesJson(names, j.turns)},
          {"shifts", axesJson(names, j.shifts)},
          {"ellipsoid_radii_m", vectorToJson(j.ellipsoid_radii_m)},
          {"towards_parent", j.towards_parent},
          {"coordinates", coordinates}};
}

Json pointJson(const Names& names, const ForeignPathPoint& p) {
  Json json{{"name", p.name}, {"body", names.body(p.body)}};
  if (!p.X_BF.isApprox(RigidTransform::Identity(), 0)) json["frame"] = toJson(p.X_BF);
  if (p.moves())
    json["moving_location_m"] = {names.function(p.p_F[0]), names.function(p.p_F[1]), names.function(p.p_F[2])};
  else
    json["location_m"] = {p.p_F[0].constant, p.p_F[1].constant, p.p_F[2].constant};
  if (const auto& c = p.condition)
    json["while"] = {{"coordinate", names.coordinate(c->coordinate)}, {"range", {c->min, c->max}}};
  return json;
}

Json muscleJson(const Names& names, const ForeignModel& model, std::size_t i) {
  const MusculotendonUnit& unit = model.musculature.units[i];
  Json points = Json::array(), wraps = Json::array();
  for (const auto& p : model.paths[i].points) points.push_back(pointJson(names, p));
  for (const auto& w : model.paths[i].wraps)
    wraps.push_back({{"object", model.wrap_objects[static_cast<std::size_t>(w.object)].name},
                     {"first_point", w.first_point},
                     {"last_point", w.last_point}});
  return {{"name", unit.name},
          {"kind", model.muscle_kinds[i]},
          {"max_isometric_force_N", unit.max_isometric_force_N},
          {"optimal_fiber_length_m", unit.optimal_fiber_length_m},
          {"tendon_slack_length_m", unit.tendon_slack_length_m},
          {"pennation_angle_at_optimal_rad", unit.pennation_angle_at_optimal_rad},
          {"points", points},
          {"wraps", wraps}};
}

}  // namespace

Json foreignModelToJson(const ForeignModel& model) {
  const Names names{model};
  Json json{{"format", "sinew.foreign_model"},
            {"version", 1},
            {"name", model.name},
            {"source", model.source},
            {"credits", model.credits},
            {"gravity_m_s2", vectorToJson(model.gravity_W_m_s2)}};
  for (const char* list : {"bodies", "coordinates", "joints", "couplings", "wrap_objects", "muscles"})
    json[list] = Json::array();
  for (const auto& b : model.bodies)
    json["bodies"].push_back({{"name", b.name},
                              {"mass_kg", b.mass_kg},
                              {"centre_of_mass_m", vectorToJson(b.p_BCom)},
                              {"inertia_kgm2", toJson(b.inertia_B_kgm2)}});
  for (const auto& c : model.coordinates)
    json["coordinates"].push_back({{"name", c.name},
                                   {"translational", c.translational},
                                   {"default", c.default_value},
                                   {"range", {c.min, c.max}},
                                   {"clamped", c.clamped},
                                   {"locked", c.locked}});
  for (const auto& j : model.joints) json["joints"].push_back(jointJson(names, j));
  for (const auto& c : model.couplings)
    json["couplings"].push_back(
        {{"name", c.name}, {"dependent", names.coordinate(c.dependent)}, {"value", names.function(c.value)}});
  for (const auto& w : model.wrap_objects)
    json["wrap_objects"].push_back({{"name", w.name},
                                    {"body", names.body(w.body)},
                                    {"pose", toJson(w.X_BO)},
                                    {"shape", w.shape == WrapShape::Cylinder ? "cylinder" : "ellipsoid"},
                                    {"radii_m", vectorToJson(w.radii_m)},
                                    {"side_axis", w.side_axis},
                                    {"side_sign", w.side_sign}});
  for (std::size_t i = 0; i < model.paths.size(); ++i) json["muscles"].push_back(muscleJson(names, model, i));
  json["warnings"] = warningsToJson(model.warnings);
  return json;
}

ForeignModel foreignModelFromJson(const JsonReader& json) {
  return Reader{json}.read();
}

void saveForeignModel(const ForeignModel& model, const std::filesystem::path& file) {
  writeFileAtomically(file, jsonText(foreignModelToJson(model)));
}

bool isForeignModelFile(const std::filesystem::path& file) {
  if (file.extension() == ".osim") return true;
  if (file.extension() != ".json") return false;
  std::string start(200, '\0');
  std::ifstream in{file, std::ios::binary};
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start.find("\"sinew.foreign_model\"") != std::string::npos;
}

ForeignModel loadForeignModel(const std::filesystem::path& file) {
  if (file.extension() == ".osim") return readOsim(file);
  const Json json = parseJson(readFile(file), file.string());
  return foreignModelFromJson(JsonReader{json, file.string()});
}

}  // namespace sinew
