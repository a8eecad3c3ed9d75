#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "core/angle.h"
#include "core/error.h"
#include "core/file.h"
#include "core/skeleton/skeleton.h"
#include "core/text.h"

namespace sinew {
namespace {

using nlohmann::json;

Eigen::Vector3d vectorFrom(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

std::string leftName(std::string name) {
  if (name.ends_with("_r")) name.back() = 'l';
  return name;
}

/// Collects the right side and the midline from the file, then adds the mirror image of every sided entry.
class SkeletonReader {
 public:
  explicit SkeletonReader(const json& root) : root_{root} {}

  Skeleton read() {
    readDrivenAxes();
    for (const auto& joint : root_.at("joints")) {
      addJoint(joint, false);
      if (joint.at("name").get<std::string>().ends_with("_r")) addJoint(joint, true);
    }
    addDrivers();
    return std::move(skeleton_);
  }

 private:
  void readDrivenAxes() {
    const json& radius = root_.at("radius");
    for (const auto& joint : root_.at("joints"))
      if (joint.at("name") == radius.at("wrist_joint"))
        forearm_axis_ = (vectorFrom(radius.at("p_UR_m")) - vectorFrom(joint.at("p_PJ_m"))).normalized();
  }

  void addJoint(const json& j, bool left) {
    const auto named = [&](const char* key) {
      const std::string name = j.at(key);
      return left ? leftName(name) : name;
    };
    Joint joint;
    joint.name = named("name");
    joint.type = typeFrom(j.at("type"));
    joint.parent = named("parent") == "world" ? -1 : skeleton_.segmentIndex(named("parent"));
    joint.child = addSegment(j.at("child"), joint.parent, left);
    joint.X_PJ.translation() = vectorFrom(j.at("p_PJ_m"));
    // The forearm hangs in mid position: a quarter turn from the supinated axes that radius and hand are described
    // in.
    if (j.at("name") == root_.at("radius").at("wrist_joint"))
      joint.X_PJ.linear() = rotationAbout<double>(forearm_axis_, std::numbers::pi / 2);
    if (left) joint.X_PJ = mirrored(joint.X_PJ);
    joint.first_coordinate = skeleton_.coordinateCount();
    for (const auto& c : j.at("coordinates")) addCoordinate(c, left);
    joint.coordinate_count = skeleton_.coordinateCount() - joint.first_coordinate;
    skeleton_.joints.push_back(joint);
  }

  static JointType typeFrom(const std::string& type) {
    if (type == "free") return JointType::Free;
    if (type == "ball") return JointType::Ball;
    if (type == "revolute") return JointType::Revolute;
    throw InputError{{"joint", "type", "free, ball or revolute", "'" + type + "'"}};
  }

  int addSegment(const std::string& right_name, int parent, bool left) {
    for (const auto& s : root_.at("segments")) {
      if (s.at("name") != right_name) continue;
      Segment segment;
      segment.name = left ? leftName(right_name) : right_name;
      segment.parent = parent;
      segment.mass_kg = s.at("mass_kg");
      segment.p_BCom = vectorFrom(s.at("p_BCom_m"));
      if (left) segment.p_BCom = mirrored(segment.p_BCom);
      segment.inertia_B_kgm2 = vectorFrom(s.at("inertia_kgm2")).asDiagonal();
      skeleton_.segments.push_back(segment);
      return static_cast<int>(skeleton_.segments.size()) - 1;
    }
    throw InputError{{"segments", right_name, "an entry", "none"}};
  }

  void addCoordinate(const json& c, bool left) {
    Coordinate coordinate;
    coordinate.name = c.at("name");
    coordinate.joint = static_cast<int>(skeleton_.joints.size());
    coordinate.axis = c.at("axis") == "forearm" ? forearm_axis_ : vectorFrom(c.at("axis"));
    coordinate.translational = c.contains("normal_m");
    if (left) {
      coordinate.name = leftName(coordinate.name);
      coordinate.axis = mirroredAxis(coordinate.axis);
    }
    const double unit = coordinate.translational ? 1 : kRadPerDeg;
    const json& normal = c.at(coordinate.translational ? "normal_m" : "normal_deg");
    const json& athlete = c.at(coordinate.translational ? "athlete_m" : "athlete_deg");
    coordinate.normal_min_rad = unit * normal.at(0).get<double>();
    coordinate.normal_max_rad = unit * normal.at(1).get<double>();
    coordinate.athlete_min_rad = unit * athlete.at(0).get<double>();
    coordinate.athlete_max_rad = unit * athlete.at(1).get<double>();
    coordinate.stop_min_rad = coordinate.athlete_min_rad;  // until a preset says otherwise
    coordinate.stop_max_rad = coordinate.athlete_max_rad;
    skeleton_.coordinates.push_back(coordinate);
  }

  void addDrivers() {
    for (const bool left : {false, true}) {
      const auto named = [&](const json& j) { return left ? leftName(j) : j.get<std::string>(); };
      const auto addMassless = [&](const json& name, int parent) {
        skeleton_.segments.push_back({.name = named(name), .parent = parent});
        return static_cast<int>(skeleton_.segments.size()) - 1;
      };
      const json& p = root_.at("patella");
      PatellaDriver& patella = skeleton_.patellae[left];
      patella.femur = skeleton_.segmentIndex(named(p.at("femur")));
      patella.segment = addMassless(p.at("segment"), patella.femur);
      const Joint& knee = skeleton_.joints[skeleton_.jointIndex(named(p.at("knee_joint")))];
      patella.knee_coordinate = knee.first_coordinate;
      patella.p_FK = knee.X_PJ.translation();
      patella.R_FK = knee.X_PJ.linear();
      patella.radius_m = patella.reference_radius_m = p.at("radius_m");
      patella.start_rad = p.at("start_deg").get<double>() * kRadPerDeg;
      for (const double deg : p.at("knee_flexion_deg")) patella.knee_flexion_rad.push_back(deg * kRadPerDeg);
      for (const double arm_m : p.at("quadriceps_arm_m")) patella.quadriceps_arm_m.push_back(arm_m);

      const json& r = root_.at("radius");
      RadiusDriver& radius = skeleton_.radii[left];
      radius.ulna = skeleton_.segmentIndex(named(r.at("ulna")));
      radius.segment = addMassless(r.at("segment"), radius.ulna);
      radius.wrist_joint = skeleton_.jointIndex(named(r.at("wrist_joint")));
      radius.p_UR = vectorFrom(r.at("p_UR_m"));
      radius.axis_U = forearm_axis_;
      if (left) {
        radius.p_UR = mirrored(radius.p_UR);
        radius.axis_U = mirroredAxis(radius.axis_U);
      }
    }
  }

  const json& root_;
  Eigen::Vector3d forearm_axis_ = Eigen::Vector3d::UnitY();
  Skeleton skeleton_;
};

void addLandmarks(Skeleton& skeleton, const std::filesystem::path& file) {
  std::istringstream in{readFile(file)};
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto cells = splitCsvLine(line);
    if (number == 1 || cells[0].empty() || cells[0].starts_with("#")) continue;
    const std::string where = file.string() + ": line " + std::to_string(number);
    if (cells.size() < 6) throw InputError{{where, "columns", "name,segment,bone,x_m,y_m,z_m,source", line}};
    Landmark landmark{cells[0],
                      skeleton.segmentIndex(cells[1]),
                      cells[2],
                      {parseNumber(cells[3], where, "x_m"), parseNumber(cells[4], where, "y_m"),
                       parseNumber(cells[5], where, "z_m")}};
    skeleton.landmarks.push_back(landmark);
    if (!landmark.name.ends_with("_r")) continue;
    landmark.name = leftName(landmark.name);
    landmark.segment = skeleton.segmentIndex(leftName(cells[1]));
    landmark.bone = leftName(landmark.bone);
    landmark.p_BL = mirrored(landmark.p_BL);
    skeleton.landmarks.push_back(landmark);
  }
}

}  // namespace

Skeleton loadReferenceSkeleton(const std::filesystem::path& resource_dir) {
  const auto file = resource_dir / "skeleton" / "reference_skeleton.json";
  Skeleton skeleton;
  try {
    const json root = json::parse(readFile(file));
    if (root.at("format") != "sinew.skeleton" || root.at("version") != 1)
      throw InputError{{file.string(), "format", "'sinew.skeleton' version 1", root.at("format").dump()}};
    skeleton = SkeletonReader{root}.read();
  } catch (const json::exception& error) {
    throw InputError{file.string() + ": " + error.what()};
  }
  addLandmarks(skeleton, resource_dir / "skeleton" / "landmarks.csv");
  return skeleton;
}

}  // namespace sinew
