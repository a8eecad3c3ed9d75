#include <algorithm>
#include <cmath>
#include <set>

#include "core/io/osim/osim_reader_internal.h"
#include "core/text.h"

namespace sinew {
namespace {

/// What our Hill curves (core/muscle/hill.h) are made with.
struct CurveParameter {
  const char* tag;
  double ours;
};
constexpr CurveParameter kCurves[] = {{"FmaxTendonStrain", 0.033},
                                      {"FmaxMuscleStrain", 0.6},
                                      {"KshapeActive", 0.45},
                                      {"KshapePassive", 5},
                                      {"Af", 0.25},
                                      {"Flen", 1.4}};

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) text += (i ? ", " : "") + names[i];
  return names.size() > kMost ? text + " and " + std::to_string(names.size() - kMost) + " more" : text;
}

}  // namespace

void OsimReader::readWrapObjects(const XmlElement& owner, int body) {
  for (const auto& object : osimObjects(owner, "WrapObjectSet")) readWrapObject(object, body);
}

void OsimReader::readWrapObject(const XmlElement& element, int body) {
  WrapObject object;
  object.name = element.name();
  object.body = body;
  object.X_BO = osimPose(element.find("translation"), element.find("xyz_body_rotation"));
  if (const auto active = element.findAny({"active", "isActive"}); active && !active->boolean()) {
    unused_wraps_[object.name] = "switched off";
    return;
  }
  if (element.tag() == "WrapCylinder") {
    const double radius_m = element["radius"].number();
    object.radii_m = {radius_m, radius_m, element["length"].number() / 2};
  } else if (element.tag() == "WrapSphere") {
    object.shape = WrapShape::Ellipsoid;
    object.radii_m.setConstant(element["radius"].number());
  } else if (element.tag() == "WrapEllipsoid") {
    object.shape = WrapShape::Ellipsoid;
    object.radii_m = Eigen::Vector3d{element["dimensions"].numbers(3).data()};
  } else {
    unused_wraps_[object.name] = element.tag();
    return;
  }
  if (!(object.radii_m.minCoeff() > 0)) element.fail("sizes > 0", "0 or less");
  if (const auto quadrant = element.find("quadrant")) {
    std::string side = quadrant->text();
    if (side != "all" && !side.empty()) {
      object.side_sign = side.starts_with('-') ? -1 : 1;
      if (side.starts_with('-') || side.starts_with('+')) side.erase(0, 1);
      if (side != "x" && side != "y" && side != "z") quadrant->fail("all, x, -x, y, -y, z or -z", "'" + side + "'");
      object.side_axis = side[0] - 'x';
    }
  }
  model_.wrap_objects.push_back(object);
}

void OsimReader::readMuscles() {
  std::map<std::string, std::vector<std::string>> others;
  for (const auto& force : osimObjects(root_, "ForceSet")) {
    const bool muscle = force.has("GeometryPath") && force.has("max_isometric_force") && force.tag() != "Ligament";
    if (muscle)
      readMuscle(force);
    else if (!readCoordinateForce(force))
      others[force.tag()].push_back(force.name());
  }
  for (const auto& [tag, names] : others)
    warn("osim_force",
         std::to_string(names.size()) + " " + tag +
             " left out, neither a muscle with a path of points nor a force of a coordinate that is known: " +
             listed(names));
}

void OsimReader::readMuscle(const XmlElement& muscle) {
  MusculotendonUnit unit;
  unit.name = muscle.name();
  if (unit.name.empty()) muscle.fail("a name", "none");
  if (std::ranges::find(model_.musculature.units, unit.name, &MusculotendonUnit::name) !=
      model_.musculature.units.end())
    muscle.fail("a name of its own", "'" + unit.name + "', the name of another muscle");
  unit.source = model_.source;
  const auto positive = [](const XmlElement& element) {
    const double value = element.number();
    if (!(value > 0)) element.fail("a number > 0", element.text());
    return value;
  };
  unit.max_isometric_force_N = positive(muscle["max_isometric_force"]);
  unit.optimal_fiber_length_m = positive(muscle["optimal_fiber_length"]);
  unit.tendon_slack_length_m = positive(muscle["tendon_slack_length"]);
  if (const auto pennation = muscle.findAny({"pennation_angle_at_optimal", "pennation_angle"})) {
    unit.pennation_angle_at_optimal_rad = pennation->number();
    if (!(unit.pennation_angle_at_optimal_rad >= 0 && unit.pennation_angle_at_optimal_rad < 1.5))
      pennation->fail("an angle from 0 to 1.5 rad", pennation->text());
  }
  noteCurves(muscle);
  model_.paths.push_back(path(muscle["GeometryPath"], unit.name));
  model_.muscle_kinds.push_back(muscle.tag());
  model_.musculature.units.push_back(std::move(unit));
}

ForeignPath OsimReader::path(const XmlElement& geometry, const std::string& muscle) {
  ForeignPath result;
  for (const auto& point : osimObjects(geometry, "PathPointSet")) result.points.push_back(pathPoint(point));
  if (result.points.size() < 2) geometry.fail("a path of two points or more", std::to_string(result.points.size()));
  readPathWraps(geometry, muscle, result);
  return result;
}

ForeignPathPoint OsimReader::pathPoint(const XmlElement& element) {
  const std::string tag = element.tag();
  if (tag != "PathPoint" && tag != "MovingPathPoint" && tag != "ConditionalPathPoint")
    element.fail("PathPoint, MovingPathPoint or ConditionalPathPoint", "<" + tag + ">");
  ForeignPathPoint point;
  point.name = element.name();
  const auto parent = element.findAny({"socket_parent_frame", "socket_parent_frame_connectee_name", "body"});
  if (!parent) element.fail("an element <socket_parent_frame>", "none");
  const OsimFrame on = frame(*parent);
  point.body = on.body;
  point.X_BF = on.X_BF;
  if (tag == "MovingPathPoint") {
    const char* functions[] = {"x_location", "y_location", "z_location"};
    const char* sockets[] = {"socket_x_coordinate", "socket_y_coordinate", "socket_z_coordinate"};
    const char* names[] = {"x_coordinate", "y_coordinate", "z_coordinate"};
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<int> coordinates;
      if (const auto c = element.findAny({sockets[i], names[i]}); c && !c->text().empty())
        coordinates.push_back(coordinate(*c, c->text()));
      point.p_F[i] = function(element[functions[i]], coordinates);
    }
    return point;
  }
  const auto location = element["location"].numbers(3);
  for (std::size_t i = 0; i < 3; ++i) point.p_F[i].constant = location[i];
  if (tag == "ConditionalPathPoint") {
    const auto c = element.findAny({"socket_coordinate", "coordinate"});
    if (!c) element.fail("an element <socket_coordinate>", "none");
    const auto range = element["range"].numbers(2);
    point.condition = ForeignPathPoint::Condition{coordinate(*c, c->text()), range[0], range[1]};
  }
  return point;
}

void OsimReader::readPathWraps(const XmlElement& geometry, const std::string& muscle, ForeignPath& into) {
  for (const auto& element : osimObjects(geometry, "PathWrapSet")) {
    const XmlElement named = element["wrap_object"];
    const std::string name = lastOfPath(named.text());
    if (const auto unused = unused_wraps_.find(name); unused != unused_wraps_.end()) {
      if (unused->second != "switched off")
        warn("osim_wrap", muscle + " does not wrap over '" + name + "': " + unused->second + " is not known");
      continue;
    }
    const auto found = std::ranges::find(model_.wrap_objects, name, &WrapObject::name);
    if (found == model_.wrap_objects.end()) named.fail("a wrap object of the model", "'" + name + "'");
    PathWrap wrap;
    wrap.object = static_cast<int>(found - model_.wrap_objects.begin());
    if (const auto range = element.find("range")) {
      const auto ends = range->numbers(2);
      const auto count = static_cast<double>(into.points.size());
      if (ends[0] > count || ends[1] > count) range->fail("numbers of points of the path", range->text());
      if (ends[0] >= 1) wrap.first_point = static_cast<int>(ends[0]) - 1;
      if (ends[1] >= 1) wrap.last_point = static_cast<int>(ends[1]) - 1;
    }
    const Eigen::Vector3d& r = found->radii_m;
    if (found->shape == WrapShape::Ellipsoid && r.maxCoeff() > r.minCoeff())
      warn("osim_wrap", muscle + " wraps over the ellipsoid '" + name + "' approximately: shortest way in a plane");
    into.wraps.push_back(wrap);
  }
}

void OsimReader::noteCurves(const XmlElement& muscle) {
  for (const auto& [tag, ours] : kCurves)
    if (const auto value = muscle.find(tag); value && std::abs(value->number() - ours) > 1e-9)
      other_curves_[tag].push_back(muscle.name());
  if (!muscle.tag().starts_with("Thelen2003Muscle")) other_curves_["kind " + muscle.tag()].push_back(muscle.name());
}

void OsimReader::warnAboutCurves() {
  if (other_curves_.empty()) return;
  std::string what;
  std::set<std::string> muscles;
  for (const auto& [parameter, names] : other_curves_) {
    what += (what.empty() ? "" : ", ") + parameter;
    muscles.insert(names.begin(), names.end());
  }
  warn("osim_curves", "forces are computed with the curves of this program (Thelen 2003), not with the file's (" +
                          what + ") of " + std::to_string(muscles.size()) +
                          " muscles: " + listed({muscles.begin(), muscles.end()}));
}

}  // namespace sinew
