#include "core/io/foreign/foreign_json.h"

#include <algorithm>
#include <fstream>
#include <set>

#include "core/file.h"
#include "core/io/osim/osim_reader.h"
#include "core/model/passive_json.h"
#include "core/model/skeleton_json.h"

namespace sinew {
namespace {

Eigen::Matrix3d matrixFromJson(const JsonReader& json) {
  const auto rows = json.items(3);
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) m.row(i) = vectorFromJson(rows[static_cast<std::size_t>(i)]);
  return m;
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

/// Indices of bodies and coordinates by name.
class Names {
 public:
  explicit Names(const ForeignModel& model) : model_{model} {}

  int body(const JsonReader& json) const {
    if (json.text() == "ground") return -1;
    const auto found = std::ranges::find(model_.bodies, json.text(), &Segment::name);
    if (found == model_.bodies.end()) json.fail("a body of the model");
    return static_cast<int>(found - model_.bodies.begin());
  }
  int coordinate(const JsonReader& json) const {
    return namedIndex(json, [&](const std::string& name) { return model_.coordinateIndex(name); });
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
                     "joints", "couplings", "coordinate_forces", "wrap_objects", "muscles", "warnings"});
    model_.name = json_["name"].text();
    model_.source = json_["source"].text();
    model_.credits = json_["credits"].text();
    model_.gravity_W_m_s2 = vectorFromJson(json_["gravity_m_s2"]);
    for (const auto& b : json_["bodies"].items()) body(b);
    for (const auto& c : json_["coordinates"].items()) coordinate(c);
    for (const auto& j : json_["joints"].items()) joint(j);
    for (const auto& c : json_["couplings"].items()) coupling(c);
    if (const auto forces = json_.find("coordinate_forces"))  // files of before have none
      for (const auto& f : forces->items()) coordinateForce(f);
    for (const auto& w : json_["wrap_objects"].items()) wrapObject(w);
    for (const auto& m : json_["muscles"].items()) muscle(m);
    model_.warnings = warningsFromJson(json_["warnings"]);
    return std::move(model_);
  }

 private:
  template <class List, class Name>
  static std::string ownName(const JsonReader& json, const List& list, Name name) {
    if (std::ranges::find(list, json.text(), name) != list.end()) json.fail("a name that nothing before has");
    return json.text();
  }

  void body(const JsonReader& json) {
    Segment b;
    b.name = ownName(json["name"], model_.bodies, &Segment::name);
    b.mass_kg = json["mass_kg"].number();
    b.p_BCom = vectorFromJson(json["centre_of_mass_m"]);
    b.inertia_B_kgm2 = matrixFromJson(json["inertia_kgm2"]);
    model_.bodies.push_back(b);
  }

  void coordinate(const JsonReader& json) {
    const auto range = json["range"].numbers(2);
    model_.coordinates.push_back({ownName(json["name"], model_.coordinates, &ForeignCoordinate::name),
                                  json["translational"].boolean(), json["default"].number(), range[0], range[1],
                                  json["clamped"].boolean(), json["locked"].boolean()});
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
    if (inner >= 0 && !placed_.contains(inner))
      json.fail("a joint after the one that places what it hangs on", j.name);
    if (!placed_.insert(outer).second) json.fail("one joint that places a body", "another one, '" + j.name + "'");
    model_.bodies[static_cast<std::size_t>(outer)].parent = inner;
    model_.joints.push_back(std::move(j));
  }

  /// What it depends on is computed before it.
  void coupling(const JsonReader& json) {
    ForeignCoupling c{json["name"].text(), names_.coordinate(json["dependent"]), names_.function(json["value"])};
    for (const auto& earlier : model_.couplings)
      if (earlier.dependent == c.dependent ||
          std::ranges::find(earlier.value.terms, c.dependent, &CoordinateFunction::Term::coordinate) !=
              earlier.value.terms.end())
        json["dependent"].fail("a coordinate that no coupling before uses");
    if (std::ranges::find(c.value.terms, c.dependent, &CoordinateFunction::Term::coordinate) != c.value.terms.end())
      json["value"].fail("a function of other coordinates");
    model_.couplings.push_back(std::move(c));
  }

  void coordinateForce(const JsonReader& json) {
    json.allowOnly({"name", "coordinate", "limit", "exponential"});
    ForeignCoordinateForce force{json["name"].text(), names_.coordinate(json["coordinate"]), {}};
    if (const auto limit = json.find("limit"))
      force.law = CoordinateLimit{(*limit)["upper"].number(), (*limit)["upper_stiffness"].number(),
                                  (*limit)["lower"].number(), (*limit)["lower_stiffness"].number(),
                                  (*limit)["transition"].number()};
    else
      force.law = passiveMomentFromJson(json["exponential"]);
    model_.coordinate_forces.push_back(std::move(force));
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
    unit.name = ownName(json["name"], model_.musculature.units, &MusculotendonUnit::name);
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
  std::set<int> placed_;
};

}  // namespace

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
