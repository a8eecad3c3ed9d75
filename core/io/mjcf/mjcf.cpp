#include "core/io/mjcf/mjcf.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/foreign/foreign_from_model.h"
#include "core/io/mjcf/mjcf_structures_internal.h"

namespace sinew {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

std::string numbers(const Eigen::VectorXd& values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : " ") + number(v);
  return text;
}

/// Text inside an attribute.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return safe;
}

std::string pose(const RigidTransform& X) {
  const Eigen::Quaterniond q{X.linear()};
  return "pos=\"" + numbers(X.translation()) + "\" quat=\"" + numbers(Eigen::Vector4d{q.w(), q.x(), q.y(), q.z()}) +
         "\"";
}

std::string range(double low, double high) {
  return "limited=\"true\" range=\"" + number(low) + " " + number(high) + "\"";
}

/// Largest turn of a ball joint in its envelope: over the corners and middles of the clinical box.
double largestTurn_rad(const Skeleton& skeleton, const Joint& joint) {
  double largest = 0;
  for (int i = 0; i < 27; ++i) {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    for (int k = 0, code = i; k < 3; ++k, code /= 3) {
      const Coordinate& c = skeleton.coordinates[joint.first_coordinate + k];
      const double angle = code % 3 == 0 ? c.athlete_min_rad : code % 3 == 1 ? c.athlete_max_rad : 0;
      R = R * rotationAbout<double>(c.axis, angle);
    }
    largest = std::max(largest, vectorFromRotation(R).norm());
  }
  return std::min(largest, std::numbers::pi);
}

/// Writes one model; the text grows in document order.
class MjcfWriter {
 public:
  explicit MjcfWriter(const Model& model)
      : skeleton_{model.skeleton},
        segments_{segmentsWithDrivenMass(model.skeleton)},
        units_{model.musculature.units},
        structures_{mjcfStructures(model, "    ")} {
    text_ = "<mujoco model=\"" + escaped(model.name) + "\">\n" +
            "  <compiler angle=\"radian\" coordinate=\"local\"/>\n"
            "  <option timestep=\"0.001\" gravity=\"0 -9.81 0\"/>\n"
            "  <size njmax=\"1000\" nconmax=\"100\"/>\n"
            "  <worldbody>\n";
    body(skeleton_.joints[0], skeleton_.joints[0].X_PJ, "    ");
    text_ += "  </worldbody>\n";
    equalities();
    tendons();
    actuators();
    text_ += "</mujoco>\n";
  }
  std::string text() && { return std::move(text_); }

 private:
  void open(const std::string& indent, const std::string& name, const RigidTransform& X) {
    text_ += indent + "<body name=\"" + escaped(name) + "\" " + pose(X) + ">\n";
  }

  void inertial(const std::string& indent, int segment) {
    const Segment& s = segments_[static_cast<std::size_t>(segment)];
    const Eigen::Matrix3d& I = s.inertia_B_kgm2;
    Eigen::VectorXd entries(6);
    entries << I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2);
    text_ += indent + "<inertial pos=\"" + numbers(s.p_BCom) + "\" mass=\"" + number(s.mass_kg) +
             "\" fullinertia=\"" + numbers(entries) + "\"/>\n";
  }

  void hinge(const std::string& indent, const std::string& name, const Eigen::Vector3d& axis,
             const Eigen::Vector3d& position, const std::string& limit) {
    text_ += indent + "<joint name=\"" + escaped(name) + "\" type=\"hinge\" axis=\"" + numbers(axis) + "\" pos=\"" +
             numbers(position) + "\" damping=\"0.1\" " + limit + "/>\n";
  }
  void coordinateHinge(const std::string& indent, const Coordinate& c, const Eigen::Vector3d& axis) {
    hinge(indent, c.name, axis, Eigen::Vector3d::Zero(), range(c.athlete_min_rad, c.athlete_max_rad));
  }

  void joint(const std::string& indent, const Joint& joint) {
    if (joint.type == JointType::Free) {
      text_ += indent + "<freejoint name=\"" + escaped(joint.name) + "\"/>\n";
    } else if (mjcfHasHinges(skeleton_, static_cast<int>(&joint - skeleton_.joints.data()))) {
      for (int i = joint.first_coordinate; i < joint.first_coordinate + joint.coordinate_count; ++i)
        coordinateHinge(indent, skeleton_.coordinates[i], skeleton_.coordinates[i].axis);
    } else {
      text_ += indent + "<joint name=\"" + escaped(joint.name) + "\" type=\"ball\" damping=\"0.1\" " +
               range(0, largestTurn_rad(skeleton_, joint)) + "/>\n";
    }
  }

  /// Path points that are pinned to this segment.
  void sites(const std::string& indent, int segment) {
    for (const auto& unit : units_)
      for (std::size_t i = 0; i < unit.path.size(); ++i) {
        const Anchor& a = *std::ranges::max_element(unit.path[i].anchors, {}, &Anchor::weight);
        if (a.segment == segment)
          text_ += indent + "<site name=\"" + escaped(unit.name) + "." + std::to_string(i) +
                   "\" size=\"0.002\" pos=\"" + numbers(a.p_B) + "\"/>\n";
      }
  }

  void body(const Joint& own_joint, const RigidTransform& X, const std::string& indent) {
    const std::string inside = indent + "  ";
    const int segment = own_joint.child;
    open(indent, skeleton_.segments[segment].name, X);
    joint(inside, own_joint);
    content(segment, inside);
    text_ += indent + "</body>\n";
  }

  /// What a body holds besides its joint: mass, sites, patella or radius, and the bodies that hang on it.
  void content(int segment, const std::string& indent) {
    const auto patella = std::ranges::find(skeleton_.patellae, segment, &PatellaDriver::femur);
    const auto radius = std::ranges::find(skeleton_.radii, segment, &RadiusDriver::ulna);
    const bool has_patella = patella != skeleton_.patellae.end(), has_radius = radius != skeleton_.radii.end();
    inertial(indent, segment);
    sites(indent, segment);
    if (has_patella) patellaBody(*patella, indent);
    if (has_radius) radiusBody(*radius, indent);
    for (const Joint& next : skeleton_.joints)
      if (next.parent == segment && !(has_radius && next.child == skeleton_.joints[radius->wrist_joint].child))
        body(next, next.X_PJ, indent);
  }

  void patellaBody(const PatellaDriver& d, const std::string& indent) {
    const Eigen::Vector3d p_KP = d.radius_m * Eigen::Vector3d{std::cos(d.start_rad), std::sin(d.start_rad), 0};
    RigidTransform X_FP = RigidTransform::Identity();
    X_FP.linear() = d.R_FK;
    X_FP.translation() = d.p_FK + d.R_FK * p_KP;
    const std::string& name = skeleton_.segments[d.segment].name;
    open(indent, name, X_FP);
    hinge(indent + "  ", name + "_glide", -Eigen::Vector3d::UnitZ(), -p_KP, "limited=\"false\"");
    inertial(indent + "  ", d.segment);
    sites(indent + "  ", d.segment);
    text_ += indent + "</body>\n";
  }

  void radiusBody(const RadiusDriver& d, const std::string& indent) {
    const std::string inside = indent + "  ", innermost = inside + "  ";
    const Joint& wrist = skeleton_.joints[d.wrist_joint];
    const Coordinate* c = &skeleton_.coordinates[wrist.first_coordinate];
    RigidTransform X_UR = RigidTransform::Identity();
    X_UR.linear() = rotationAbout<double>(d.axis_U, std::numbers::pi / 2);
    X_UR.translation() = d.p_UR;
    open(indent, skeleton_.segments[d.segment].name, X_UR);
    coordinateHinge(inside, c[0], d.axis_U);
    inertial(inside, d.segment);
    sites(inside, d.segment);
    open(inside, skeleton_.segments[wrist.child].name, X_UR.inverse() * wrist.X_PJ);
    coordinateHinge(innermost, c[1], c[1].axis);
    coordinateHinge(innermost, c[2], c[2].axis);
    content(wrist.child, innermost);
    text_ += inside + "</body>\n" + indent + "</body>\n";
  }

  void equalities() {
    text_ += "  <equality>\n";
    for (const PatellaDriver& d : skeleton_.patellae) {
      const PatellaQuartic fit = patellaQuartic(skeleton_, d);
      text_ += "    <joint joint1=\"" + escaped(skeleton_.segments[d.segment].name) + "_glide\" joint2=\"" +
               escaped(skeleton_.coordinates[d.knee_coordinate].name) + "\" polycoef=\"" +
               numbers(Eigen::Map<const Eigen::VectorXd>(fit.coefficients, 5)) + "\"/>\n";
    }
    text_ += "  </equality>\n";
  }

  void tendons() {
    text_ += "  <tendon>\n";
    for (const auto& unit : units_) {
      text_ += "    <spatial name=\"" + escaped(unit.name) + "\">";
      for (std::size_t i = 0; i < unit.path.size(); ++i)
        text_ += "<site site=\"" + escaped(unit.name) + "." + std::to_string(i) + "\"/>";
      text_ += "</spatial>\n";
    }
    text_ += "  </tendon>\n";
  }

  /// MuJoCo finds l0 and tendon slack from two pairs of fibre and unit lengths. Its active curve is two parabolas
  /// that pass one half midway between 1 and `lmin` or `lmax`; its passive one is quadratic to the middle between 1
  /// and `lmax` and straight beyond, where it reaches 1.5 `fpmax` at `lmax`.
  void actuators() {
    constexpr double kShort = 0.5;
    text_ += "  <actuator>\n" + structures_;  // MuJoCo wants actuators without a state before those with one
    for (const auto& unit : units_) {
      const double l0 = unit.optimal_fiber_length_m, slack = unit.tendon_slack_length_m;
      const HillParameters& hill = unit.curves;
      const double longest = 1 + hill.passive_strain;
      const double half_width = std::sqrt(hill.active_width * std::numbers::ln2);  // of the Gaussian, at one half
      text_ += "    <muscle name=\"" + escaped(unit.name) + "\" tendon=\"" + escaped(unit.name) + "\" force=\"" +
               number(unit.max_isometric_force_N * std::cos(unit.pennation_angle_at_optimal_rad)) + "\" range=\"" +
               number(kShort) + " " + number(longest) + "\" lengthrange=\"" + number(slack + kShort * l0) + " " +
               number(slack + longest * l0) + "\" lmin=\"" + number(std::max(0.0, 1 - 2 * half_width)) +
               "\" lmax=\"" + number(longest) + "\" vmax=\"" + number(hill.max_velocity_1_s) + "\" fpmax=\"" +
               number(2.0 / 3) + "\" fvmax=\"" + number(hill.max_lengthening) + "\"/>\n";
    }
    text_ += "  </actuator>\n";
  }

  const Skeleton& skeleton_;
  const std::vector<Segment> segments_;  ///< driven bones with their mass
  const std::vector<MusculotendonUnit>& units_;
  const std::string structures_;  ///< actuators, before those of the muscles
  std::string text_;
};

}  // namespace

std::string mjcfText(const Model& model) {
  return MjcfWriter{model}.text();
}

LengthDeviation mjcfDeviation(const Model& model) {
  LengthDeviation deviation =
      lengthDeviation(model, foreignFromModel(model, {.blended = ForeignOptions::Blended::HeaviestAnchor,
                                                      .patella = ForeignOptions::Patella::Quartic}));
  deviation.structures = structureDeviation(
      model, [&](const Eigen::VectorXd& clinical) { return mjcfStructureMoments_Nm(model, clinical); });
  return deviation;
}

}  // namespace sinew
