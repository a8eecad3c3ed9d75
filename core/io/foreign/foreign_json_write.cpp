#include "core/io/foreign/foreign_json.h"
#include "core/model/passive_json.h"
#include "core/model/skeleton_json.h"

namespace sinew {
namespace {

Json toJson(const Eigen::Matrix3d& m) {
  return {vectorToJson(m.row(0)), vectorToJson(m.row(1)), vectorToJson(m.row(2))};
}
Json toJson(const RigidTransform& X) {
  return {{"position_m", vectorToJson(X.translation())}, {"rotation", toJson(X.linear())}};
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
/// Names of bodies and coordinates for their indices.
class Names {
 public:
  explicit Names(const ForeignModel& model) : model_{model} {}

  std::string body(int i) const { return i < 0 ? "ground" : model_.bodies[static_cast<std::size_t>(i)].name; }
  std::string coordinate(int i) const { return model_.coordinates[static_cast<std::size_t>(i)].name; }

  Json function(const CoordinateFunction& f) const {
    Json terms = Json::array();
    for (const auto& t : f.terms)
      terms.push_back({{"coordinate", coordinate(t.coordinate)}, {"function", toJson(t.function)}});
    return {{"constant", f.constant}, {"terms", terms}};
  }

 private:
  const ForeignModel& model_;
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

Json forceJson(const Names& names, const ForeignCoordinateForce& f) {
  Json json{{"name", f.name}, {"coordinate", names.coordinate(f.coordinate)}};
  if (const auto* limit = std::get_if<CoordinateLimit>(&f.law))
    json["limit"] = {{"upper", limit->upper},
                     {"upper_stiffness", limit->upper_stiffness},
                     {"lower", limit->lower},
                     {"lower_stiffness", limit->lower_stiffness},
                     {"transition", limit->transition}};
  else
    json["exponential"] = passiveMomentToJson(std::get<PassiveMoment>(f.law));
  return json;
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
  for (const char* list :
       {"bodies", "coordinates", "joints", "couplings", "coordinate_forces", "wrap_objects", "muscles"})
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
  for (const auto& f : model.coordinate_forces) json["coordinate_forces"].push_back(forceJson(names, f));
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

}  // namespace sinew
