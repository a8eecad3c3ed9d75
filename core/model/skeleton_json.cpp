#include "core/model/skeleton_json.h"

#include <numeric>

namespace sinew {
namespace {

Json matrixToJson(const Eigen::Matrix3d& m) {
  Json json = Json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) json.push_back(m(row, column));
  return json;
}

Eigen::Matrix3d matrixFromJson(const JsonReader& json) {
  const auto values = json.numbers(9);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{values.data()};
}

Eigen::Matrix3d rotationFromJson(const JsonReader& json) {
  const Eigen::Matrix3d R = matrixFromJson(json);
  constexpr double kTolerance = 1e-6;
  if ((R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > kTolerance || R.determinant() < 0)
    json.fail("a rotation matrix, row by row");
  return R;
}

std::string segmentName(const Skeleton& s, int segment) {
  return segment < 0 ? "world" : s.segments[segment].name;
}

const char* nameOf(JointType type) {
  switch (type) {
    case JointType::Free:
      return "free";
    case JointType::Ball:
      return "ball";
    case JointType::Revolute:
      return "revolute";
  }
  return "";
}

Json coordinateToJson(const Coordinate& c) {
  const char* unit = c.translational ? "_m" : "_rad";
  const auto range = [](double low, double high) { return Json::array({low, high}); };
  return {{"name", c.name},
          {"axis", vectorToJson(c.axis)},
          {std::string{"normal"} + unit, range(c.normal_min_rad, c.normal_max_rad)},
          {std::string{"athlete"} + unit, range(c.athlete_min_rad, c.athlete_max_rad)},
          {std::string{"stop"} + unit, range(c.stop_min_rad, c.stop_max_rad)}};
}

Coordinate coordinateFromJson(const JsonReader& json, int joint) {
  json.allowOnly({"name", "axis", "normal_rad", "normal_m", "athlete_rad", "athlete_m", "stop_rad", "stop_m"});
  Coordinate c;
  c.name = json["name"].text();
  c.joint = joint;
  c.axis = vectorFromJson(json["axis"]);
  if (std::abs(c.axis.norm() - 1) > 1e-6) json["axis"].fail("a unit vector");
  c.translational = json.find("normal_m").has_value();
  const auto normal = json[c.translational ? "normal_m" : "normal_rad"].numbers(2);
  const auto athlete = json[c.translational ? "athlete_m" : "athlete_rad"].numbers(2);
  // Files from before presets have no stops of their own: the widest ones.
  const auto stop_json = json.find(c.translational ? "stop_m" : "stop_rad");
  const auto stop = stop_json ? stop_json->numbers(2) : athlete;
  if (normal[0] > normal[1] || athlete[0] > athlete[1] || stop[0] > stop[1])
    json.fail("limits in the order lower, upper");
  c.normal_min_rad = normal[0], c.normal_max_rad = normal[1];
  c.athlete_min_rad = athlete[0], c.athlete_max_rad = athlete[1];
  c.stop_min_rad = stop[0], c.stop_max_rad = stop[1];
  return c;
}

Segment segmentFromJson(const JsonReader& json, const Skeleton& s) {
  json.allowOnly({"name", "parent", "mass_kg", "center_of_mass_m", "inertia_kgm2"});
  Segment segment;
  segment.name = json["name"].text();
  for (const auto& other : s.segments)
    if (other.name == segment.name) json["name"].fail("a name of its own", "'" + segment.name + "' twice");
  segment.parent = -1;
  if (json["parent"].text() != "world")
    segment.parent = namedIndex(json["parent"], [&](const std::string& n) { return s.segmentIndex(n); });
  segment.mass_kg = json["mass_kg"].numberIn(0, 1000);
  segment.p_BCom = vectorFromJson(json["center_of_mass_m"]);
  segment.inertia_B_kgm2 = matrixFromJson(json["inertia_kgm2"]);
  return segment;
}

Json editedRangeToJson(const EditedRange& range) {
  Json steps = Json::array();
  for (const RangeStep& s : range.steps)
    steps.push_back({{"twist_factor", s.factor},
                     {"twist_shift_rad", s.shift_rad},
                     {"twist_center_rad", s.centre_rad},
                     {"cone_factor", s.cone_factor},
                     {"cone_center", vectorToJson(s.centre_J)},
                     {"tilt", matrixToJson(s.tilt_J)}});
  return {{"shaft", vectorToJson(range.shaft_J)},
          {"stop_min_rad", vectorToJson(range.stop_min_rad)},
          {"stop_max_rad", vectorToJson(range.stop_max_rad)},
          {"steps", steps}};
}

EditedRange editedRangeFromJson(const JsonReader& json) {
  json.allowOnly({"shaft", "stop_min_rad", "stop_max_rad", "steps"});
  EditedRange range;
  range.shaft_J = vectorFromJson(json["shaft"]);
  if (std::abs(range.shaft_J.norm() - 1) > 1e-6) json["shaft"].fail("a unit vector");
  range.stop_min_rad = vectorFromJson(json["stop_min_rad"]);
  range.stop_max_rad = vectorFromJson(json["stop_max_rad"]);
  if ((range.stop_min_rad.array() > range.stop_max_rad.array()).any()) json.fail("stops in the order lower, upper");
  for (const JsonReader& step : json["steps"].items()) {
    step.allowOnly({"twist_factor", "twist_shift_rad", "twist_center_rad", "cone_factor", "cone_center", "tilt"});
    RangeStep s{.factor = step["twist_factor"].positive(),
                .shift_rad = step["twist_shift_rad"].number(),
                .centre_rad = step["twist_center_rad"].number(),
                .cone_factor = step["cone_factor"].positive(),
                .centre_J = vectorFromJson(step["cone_center"]),
                .tilt_J = rotationFromJson(step["tilt"])};
    if (std::abs(s.centre_J.norm() - 1) > 1e-6) step["cone_center"].fail("a unit vector");
    range.steps.push_back(s);
  }
  return range;
}

void readJoint(const JsonReader& json, Skeleton& s) {
  json.allowOnly({"name", "type", "parent", "child", "translation_m", "rotation", "coordinates", "edited_range"});
  Joint joint;
  joint.name = json["name"].text();
  const std::string type = json["type"].oneOf({"free", "ball", "revolute"});
  joint.type = type == "free" ? JointType::Free : type == "ball" ? JointType::Ball : JointType::Revolute;
  joint.coordinate_count = type == "free" ? 6 : type == "ball" ? 3 : 1;
  joint.child = namedIndex(json["child"], [&](const std::string& n) { return s.segmentIndex(n); });
  if (joint.child != s.movingSegmentCount()) json["child"].fail("the segment of the same place in the list");
  joint.parent = s.segments[joint.child].parent;
  if (json["parent"].text() != segmentName(s, joint.parent)) json["parent"].fail("the parent of the child segment");
  joint.X_PJ.translation() = vectorFromJson(json["translation_m"]);
  joint.X_PJ.linear() = rotationFromJson(json["rotation"]);
  joint.first_coordinate = s.coordinateCount();
  const int index = s.movingSegmentCount();
  for (const auto& c : json["coordinates"].items(static_cast<std::size_t>(joint.coordinate_count)))
    s.coordinates.push_back(coordinateFromJson(c, index));
  if (const auto edited = json.find("edited_range")) {
    if (joint.type != JointType::Ball) edited->fail("a ball joint's");
    joint.edited = editedRangeFromJson(*edited);
  }
  s.joints.push_back(joint);
}

Json patellaToJson(const Skeleton& s, const PatellaDriver& d) {
  return {{"segment", s.segments[d.segment].name},
          {"femur", s.segments[d.femur].name},
          {"knee_coordinate", s.coordinates[d.knee_coordinate].name},
          {"knee_center_m", vectorToJson(d.p_FK)},
          {"knee_rotation", matrixToJson(d.R_FK)},
          {"radius_m", d.radius_m},
          {"start_rad", d.start_rad},
          {"knee_flexion_rad", d.knee_flexion_rad},
          {"quadriceps_arm_m", d.quadriceps_arm_m},
          {"reference_radius_m", d.reference_radius_m}};
}

PatellaDriver patellaFromJson(const JsonReader& json, const Skeleton& s) {
  json.allowOnly({"segment", "femur", "knee_coordinate", "knee_center_m", "knee_rotation", "radius_m", "start_rad",
                  "knee_flexion_rad", "quadriceps_arm_m", "reference_radius_m"});
  const auto segment = [&](const std::string& n) { return s.segmentIndex(n); };
  PatellaDriver d;
  d.segment = namedIndex(json["segment"], segment);
  d.femur = namedIndex(json["femur"], segment);
  d.knee_coordinate = namedIndex(json["knee_coordinate"], [&](const std::string& n) { return s.coordinateIndex(n); });
  d.p_FK = vectorFromJson(json["knee_center_m"]);
  d.R_FK = rotationFromJson(json["knee_rotation"]);
  d.radius_m = json["radius_m"].positive();
  d.start_rad = json["start_rad"].number();
  d.knee_flexion_rad = json["knee_flexion_rad"].numbers();
  d.quadriceps_arm_m = json["quadriceps_arm_m"].numbers(d.knee_flexion_rad.size());
  if (d.knee_flexion_rad.size() < 2) json["knee_flexion_rad"].fail("two angles or more");
  d.reference_radius_m = json["reference_radius_m"].positive();
  return d;
}

Json radiusToJson(const Skeleton& s, const RadiusDriver& d) {
  return {{"segment", s.segments[d.segment].name},
          {"ulna", s.segments[d.ulna].name},
          {"wrist_joint", s.joints[d.wrist_joint].name},
          {"head_center_m", vectorToJson(d.p_UR)},
          {"axis", vectorToJson(d.axis_U)}};
}

RadiusDriver radiusFromJson(const JsonReader& json, const Skeleton& s) {
  json.allowOnly({"segment", "ulna", "wrist_joint", "head_center_m", "axis"});
  const auto segment = [&](const std::string& n) { return s.segmentIndex(n); };
  RadiusDriver d;
  d.segment = namedIndex(json["segment"], segment);
  d.ulna = namedIndex(json["ulna"], segment);
  d.wrist_joint = namedIndex(json["wrist_joint"], [&](const std::string& n) { return s.jointIndex(n); });
  d.p_UR = vectorFromJson(json["head_center_m"]);
  d.axis_U = vectorFromJson(json["axis"]);
  if (std::abs(d.axis_U.norm() - 1) > 1e-6) json["axis"].fail("a unit vector");
  return d;
}

}  // namespace

Json vectorToJson(const Eigen::Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Eigen::Vector3d vectorFromJson(const JsonReader& json) {
  const auto v = json.numbers(3);
  return {v[0], v[1], v[2]};
}

Json skeletonToJson(const Skeleton& s) {
  Json segments = Json::array(), joints = Json::array(), landmarks = Json::array();
  for (const Segment& segment : s.segments)
    segments.push_back({{"name", segment.name},
                        {"parent", segmentName(s, segment.parent)},
                        {"mass_kg", segment.mass_kg},
                        {"center_of_mass_m", vectorToJson(segment.p_BCom)},
                        {"inertia_kgm2", matrixToJson(segment.inertia_B_kgm2)}});
  for (const Joint& joint : s.joints) {
    Json coordinates = Json::array();
    for (int i = 0; i < joint.coordinate_count; ++i)
      coordinates.push_back(coordinateToJson(s.coordinates[joint.first_coordinate + i]));
    joints.push_back({{"name", joint.name},
                      {"type", nameOf(joint.type)},
                      {"parent", segmentName(s, joint.parent)},
                      {"child", s.segments[joint.child].name},
                      {"translation_m", vectorToJson(joint.X_PJ.translation())},
                      {"rotation", matrixToJson(joint.X_PJ.linear())},
                      {"coordinates", coordinates}});
    if (!joint.edited.steps.empty()) joints.back()["edited_range"] = editedRangeToJson(joint.edited);
  }
  for (const Landmark& landmark : s.landmarks)
    landmarks.push_back({{"name", landmark.name},
                         {"segment", s.segments[landmark.segment].name},
                         {"bone", landmark.bone},
                         {"position_m", vectorToJson(landmark.p_BL)}});
  Json patellae = Json::array(), radii = Json::array();
  for (int side = 0; side < 2; ++side) {
    patellae.push_back(patellaToJson(s, s.patellae[side]));
    radii.push_back(radiusToJson(s, s.radii[side]));
  }
  return {
      {"segments", segments}, {"joints", joints}, {"landmarks", landmarks}, {"patellae", patellae}, {"radii", radii}};
}

Skeleton skeletonFromJson(const JsonReader& json) {
  json.allowOnly({"segments", "joints", "landmarks", "patellae", "radii"});
  Skeleton s;
  for (const auto& segment : json["segments"].items()) s.segments.push_back(segmentFromJson(segment, s));
  const auto joints = json["joints"].items();
  if (joints.size() > s.segments.size()) json["joints"].fail("at most one joint a segment");
  for (const auto& joint : joints) readJoint(joint, s);
  for (const auto& l : json["landmarks"].items()) {
    l.allowOnly({"name", "segment", "bone", "position_m"});
    s.landmarks.push_back({l["name"].text(),
                           namedIndex(l["segment"], [&](const std::string& n) { return s.segmentIndex(n); }),
                           l["bone"].text(), vectorFromJson(l["position_m"])});
  }
  const auto patellae = json["patellae"].items(2), radii = json["radii"].items(2);
  for (std::size_t side = 0; side < 2; ++side) {
    s.patellae[side] = patellaFromJson(patellae[side], s);
    s.radii[side] = radiusFromJson(radii[side], s);
  }
  return s;
}

}  // namespace sinew
