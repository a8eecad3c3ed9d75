#include "core/io/mjcf/mjcf_structures_internal.h"

#include <algorithm>
#include <cstdio>

#include "core/passive/structure_moments.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

/// e^x as a sum of max(0, x - at) * slope: of all such sums of four the one with the least largest error over x <= ln
/// 2 (equal and alternating: 0.0249).
struct Hinge {
  double at, slope;
};
constexpr Hinge kHinges[] = {
    {-3.691754, 0.089520}, {-1.515124, 0.294119}, {-0.488114, 0.493647}, {0.188289, 0.693090}};

/// Joint and direction that a coordinate is for MuJoCo.
std::string transmission(const Skeleton& skeleton, const Coordinate& c, int index) {
  const Joint& joint = skeleton.joints[std::size_t(c.joint)];
  if (mjcfHasHinges(skeleton, c.joint)) return "joint=\"" + c.name + "\" gear=\"1\"";
  const Eigen::Vector3d& axis = skeleton.coordinates[std::size_t(index)].axis;
  char gear[96];
  std::snprintf(gear, sizeof gear, "%.12g %.12g %.12g", axis.x(), axis.y(), axis.z());
  return "joint=\"" + joint.name + "\" gear=\"" + gear + "\"";
}

/// One actuator: force = offset + slope * length where that has the sign of `direction`, otherwise 0.
std::string actuator(const std::string& name, const std::string& transmission, double offset, double slope,
                     int direction) {
  constexpr double kUnlimited = 1e7;
  char text[160];
  std::snprintf(text, sizeof text, "biasprm=\"%.12g %.12g 0\" forcelimited=\"true\" forcerange=\"%g %g\"", offset,
                slope, direction < 0 ? -kUnlimited : 0, direction < 0 ? 0 : kUnlimited);
  return "<general name=\"" + name + "\" " + transmission + " gaintype=\"fixed\" gainprm=\"0\" biastype=\"affine\" " +
         text + "/>\n";
}

/// Moment of one coordinate's actuators at their length.
double hingesMoment_Nm(const PassiveMoment& m, double length_rad) {
  double moment_Nm = 0;
  for (const Hinge& hinge : kHinges) {
    moment_Nm -=
        m.upper_Nm * hinge.slope * std::max(0.0, m.upper_rate_per_rad * (length_rad - m.upper_rad) - hinge.at);
    moment_Nm +=
        m.lower_Nm * hinge.slope * std::max(0.0, m.lower_rate_per_rad * (m.lower_rad - length_rad) - hinge.at);
  }
  return moment_Nm;
}

}  // namespace

bool mjcfHasHinges(const Skeleton& skeleton, int joint) {
  const Joint& j = skeleton.joints[std::size_t(joint)];
  if (j.type != JointType::Ball) return j.type == JointType::Revolute;
  if (std::ranges::any_of(skeleton.radii, [&](const RadiusDriver& d) { return d.wrist_joint == joint; })) return true;
  constexpr double kFree_rad = 1.5;  // 86 deg
  const Coordinate& middle = skeleton.coordinates[std::size_t(j.first_coordinate + 1)];
  return std::max(middle.athlete_max_rad, -middle.athlete_min_rad) < kFree_rad;
}

Eigen::VectorXd mjcfStructureMoments_Nm(const Model& model, const Eigen::VectorXd& clinical) {
  const Skeleton& s = model.skeleton;
  const Posture posture = postureFromClinical(s, clinical);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(s.coordinateCount());
  for (int j = 0; !model.passive_moments.empty() && j < static_cast<int>(s.joints.size()); ++j) {
    const Joint& joint = s.joints[std::size_t(j)];
    const int first = joint.first_coordinate;
    if (joint.type == JointType::Free) continue;
    if (mjcfHasHinges(s, j)) {
      for (int i = first; i < first + joint.coordinate_count; ++i)
        result[i] = hingesMoment_Nm(model.passive_moments[std::size_t(i)], clinical[i]);
      continue;
    }
    Eigen::Vector3d moment_B_Nm = Eigen::Vector3d::Zero();
    for (int i = first; i < first + 3; ++i) {
      const Eigen::Vector3d& axis = s.coordinates[std::size_t(i)].axis;
      moment_B_Nm +=
          axis * hingesMoment_Nm(model.passive_moments[std::size_t(i)], axis.dot(posture.segment<3>(first)));
    }
    // The rotation vector is the same in both frames, the moment is turned with the child.
    const Eigen::Matrix3d R_JB = rotationFromVector<double>(posture.segment<3>(first));
    result.segment<3>(first) = angleRates(s, joint, clinical.segment<3>(first)).transpose() * (R_JB * moment_B_Nm);
  }
  return result;
}

std::string mjcfStructures(const Model& model, const std::string& indent) {
  std::string text;
  for (std::size_t i = 0; i < model.passive_moments.size(); ++i) {
    const PassiveMoment& m = model.passive_moments[i];
    const Coordinate& c = model.skeleton.coordinates[i];
    const std::string where = transmission(model.skeleton, c, static_cast<int>(i));
    for (const bool upper : {false, true}) {
      const double moment_Nm = upper ? m.upper_Nm : m.lower_Nm;
      const double rate_per_rad = upper ? m.upper_rate_per_rad : m.lower_rate_per_rad;
      const double angle_rad = upper ? m.upper_rad : m.lower_rad;
      int number = 0;
      for (const Hinge& hinge : kHinges) {
        if (!(moment_Nm > 0)) break;
        const double slope = moment_Nm * hinge.slope * rate_per_rad;
        const double begins_rad = angle_rad + (upper ? hinge.at : -hinge.at) / rate_per_rad;
        text += indent + actuator(c.name + (upper ? ".max." : ".min.") + std::to_string(++number), where,
                                  slope * begins_rad, -slope, upper ? -1 : 1);
      }
    }
  }
  return text;
}

}  // namespace sinew
