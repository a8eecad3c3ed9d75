#include <algorithm>
#include <numbers>

#include "core/io/osim/osim_reader_internal.h"

namespace sinew {
namespace {

/// One character a coordinate, in the order in which the joint of this kind has them: X, Y, Z turns; x, y, z shifts.
const char* motionOf(const std::string& kind) {
  if (kind == "WeldJoint") return "";
  if (kind == "PinJoint") return "Z";
  if (kind == "SliderJoint") return "x";
  if (kind == "UniversalJoint") return "XY";
  if (kind == "PlanarJoint") return "Zxy";
  if (kind == "GimbalJoint" || kind == "BallJoint" || kind == "EllipsoidJoint") return "XYZ";
  if (kind == "FreeJoint") return "XYZxyz";
  return nullptr;
}

void setUnitAxes(ForeignJoint& joint) {
  for (int i = 0; i < 3; ++i)
    joint.turns[static_cast<std::size_t>(i)].axis = joint.shifts[static_cast<std::size_t>(i)].axis =
        Eigen::Vector3d::Unit(i);
}

}  // namespace

void OsimReader::readJoints() {
  for (const auto& body : osimObjects(root_, "BodySet"))
    if (const auto holder = body.find("Joint"); holder && !holder->children().empty())
      readOldJoint(holder->children().front(), bodyNamed(body, body.name()));
  for (const auto& joint : osimObjects(root_, "JointSet")) {
    if (const auto child = joint.find("body"); child && joint.has("parent_body")) {
      readOldJoint(joint, bodyNamed(*child, child->text()));
      continue;
    }
    const std::string path = "/jointset/" + joint.name();
    if (const auto own = joint.find("frames")) readOwnFrames(*own, path);
    const auto parent = joint.findAny({"socket_parent_frame", "socket_parent_frame_connectee_name"});
    const auto child = joint.findAny({"socket_child_frame", "socket_child_frame_connectee_name"});
    if (!parent || !child) joint.fail("elements <socket_parent_frame> and <socket_child_frame>", "one or none");
    readJoint(joint, frame(*parent, path), frame(*child, path));
  }
  orderJoints();
  markTranslations();
}

/// Versions 2 and 3: frames by location and orientation, the joint inside the body that it moves.
void OsimReader::readOldJoint(const XmlElement& joint, OsimFrame on_child) {
  const XmlElement parent = joint["parent_body"];
  OsimFrame on_parent = bodyNamed(parent, parent.text());
  on_parent.X_BF = osimPose(joint.find("location_in_parent"), joint.find("orientation_in_parent"));
  on_child.X_BF = osimPose(joint.findAny({"location", "location_in_child"}),
                           joint.findAny({"orientation", "orientation_in_child"}));
  readJoint(joint, on_parent, on_child);
}

void OsimReader::readJoint(const XmlElement& element, const OsimFrame& parent, const OsimFrame& child) {
  ForeignJoint joint;
  joint.name = element.name();
  joint.kind = element.tag();
  joint.parent = parent.body;
  joint.child = child.body;
  joint.X_PF = parent.X_BF;
  joint.X_BM = child.X_BF;
  if (joint.parent == joint.child) element.fail("two bodies", "the same body twice");
  if (const auto reverse = element.find("reverse"); reverse && reverse->boolean())
    warn("osim_joint", "joint '" + joint.name + "' asks for a reversed tree, which does not move anything; ignored");
  readCoordinates(element, joint);
  if (joint.kind == "CustomJoint") {
    customMotion(element, joint);
  } else if (const char* motion = motionOf(joint.kind)) {
    setUnitAxes(joint);
    const std::size_t expected = std::string_view{motion}.size();
    if (joint.coordinates.size() != expected)
      element.fail(std::to_string(expected) + " coordinates", std::to_string(joint.coordinates.size()));
    fixedMotion(joint);
    if (joint.kind == "EllipsoidJoint")
      joint.ellipsoid_radii_m = Eigen::Vector3d{element["radii_x_y_z"].numbers(3).data()};
  } else {
    setUnitAxes(joint);
    warn("osim_joint", joint.kind + " '" + joint.name + "' is not known and is read as rigid");
  }
  model_.joints.push_back(std::move(joint));
}

void OsimReader::fixedMotion(ForeignJoint& joint) {
  const std::string motion = motionOf(joint.kind);
  std::size_t turn = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const char m = motion[i];
    const bool turns = m <= 'Z';
    const int axis = turns ? m - 'X' : m - 'x';
    ForeignAxis& into = turns ? joint.turns[turn++] : joint.shifts[static_cast<std::size_t>(axis)];
    into.axis = Eigen::Vector3d::Unit(axis);
    into.amount = CoordinateFunction::of(joint.coordinates[i], ScalarFunction::line(1));
  }
}

void OsimReader::readCoordinates(const XmlElement& element, ForeignJoint& into) {
  std::vector<XmlElement> list = osimObjects(element, "CoordinateSet");
  if (const auto direct = element.find("coordinates"); direct && list.empty()) list = direct->children();
  for (const auto& item : list) {
    ForeignCoordinate c;
    c.name = item.name();
    if (c.name.empty()) item.fail("a name", "none");
    if (std::ranges::find(model_.coordinates, c.name, &ForeignCoordinate::name) != model_.coordinates.end())
      item.fail("a name of its own", "'" + c.name + "', the name of another coordinate");
    if (const auto value = item.findAny({"default_value", "initial_value"})) c.default_value = value->number();
    if (const auto range = item.find("range")) {
      const auto ends = range->numbers(2);
      if (ends[0] > ends[1]) range->fail("lower and upper end", "'" + range->text() + "'");
      c.min = ends[0];
      c.max = ends[1];
    }
    if (const auto clamped = item.find("clamped")) c.clamped = clamped->boolean();
    if (const auto locked = item.find("locked")) c.locked = locked->boolean();
    if (const auto motion = item.find("motion_type")) c.translational = motion->text() == "translational";
    if (const auto prescribed = item.find("prescribed_function");
        prescribed && !prescribed->children().empty() && item.has("prescribed") && item["prescribed"].boolean())
      warn("osim_prescribed", "coordinate '" + c.name + "' is prescribed over time, which is not used");
    into.coordinates.push_back(static_cast<int>(model_.coordinates.size()));
    model_.coordinates.push_back(c);
  }
}

void OsimReader::customMotion(const XmlElement& element, ForeignJoint& into) {
  const XmlElement transform = element["SpatialTransform"];
  std::size_t turn = 0, shift = 0;
  for (const auto& child : transform.children()) {
    if (child.tag() != "TransformAxis") child.fail("<TransformAxis>", "<" + child.tag() + ">");
    const bool turns = child.name().starts_with("rotation") || (child.name().empty() && turn < 3);
    ForeignAxis& axis =
        turns ? into.turns.at(std::min<std::size_t>(turn, 2)) : into.shifts.at(std::min<std::size_t>(shift, 2));
    if ((turns ? turn++ : shift++) > 2) transform.fail("three rotations and three translations", "more");
    const XmlElement direction = child["axis"];
    axis.axis = Eigen::Vector3d{direction.numbers(3).data()};
    if (!(axis.axis.norm() > 0)) direction.fail("a direction", "'" + direction.text() + "'");
    axis.axis.normalize();
    std::vector<int> coordinates;
    if (const auto names = child.find("coordinates"))
      for (const auto& name : names->words()) coordinates.push_back(coordinate(*names, name));
    axis.amount = function(child, coordinates);
  }
}

/// Joints in an order in which each hangs on a body that is placed. A joint whose child is placed and whose parent is
/// not is followed backwards; one between two placed bodies closes a loop.
void OsimReader::orderJoints() {
  std::vector<ForeignJoint> waiting = std::move(model_.joints);
  model_.joints.clear();
  std::vector<bool> placed(model_.bodies.size() + 1, false);  // by body + 1
  placed[0] = true;
  const auto isPlaced = [&](int body) { return placed[static_cast<std::size_t>(body + 1)]; };
  for (bool progress = true; progress;) {
    progress = false;
    for (auto joint = waiting.begin(); joint != waiting.end();) {
      const bool forwards = isPlaced(joint->parent), backwards = isPlaced(joint->child);
      if (!forwards && !backwards) {
        ++joint;
        continue;
      }
      if (forwards && backwards) {
        warn("osim_loop", "joint '" + joint->name + "' closes a loop and is not held");
      } else {
        joint->towards_parent = backwards;
        const int outer = backwards ? joint->parent : joint->child, inner = backwards ? joint->child : joint->parent;
        placed[static_cast<std::size_t>(outer + 1)] = true;
        model_.bodies[static_cast<std::size_t>(outer)].parent = inner;
        model_.joints.push_back(*joint);
      }
      joint = waiting.erase(joint);
      progress = true;
    }
  }
  for (std::size_t i = 0; i < model_.bodies.size(); ++i)
    if (!isPlaced(static_cast<int>(i)))
      warn("osim_body",
           "body '" + model_.bodies[i].name + "' hangs on nothing and rests at the origin of the ground");
}

/// A coordinate that shifts and never turns is a length.
void OsimReader::markTranslations() {
  std::vector<bool> turns(model_.coordinates.size(), false), shifts = turns;
  for (const auto& joint : model_.joints) {
    for (const auto& axis : joint.turns)
      for (const auto& term : axis.amount.terms) turns[static_cast<std::size_t>(term.coordinate)] = true;
    for (const auto& axis : joint.shifts)
      for (const auto& term : axis.amount.terms) shifts[static_cast<std::size_t>(term.coordinate)] = true;
  }
  for (std::size_t i = 0; i < turns.size(); ++i)
    if (shifts[i] && !turns[i]) model_.coordinates[i].translational = true;
}

}  // namespace sinew
