#include "core/rom/maps/rom_map.h"

#include <algorithm>
#include <numbers>

#include "core/error.h"
#include "core/posture/validity.h"
#include "core/rom/maps/rom_cells_internal.h"

namespace sinew {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance_rad = 1e-9;

/// From the joint centre along the child's bone: to the next joint down the chain. A segment that ends there has its
/// own long axis: the foot points forward, the hand towards its centre of mass.
Eigen::Vector3d shaftOf(const Skeleton& skeleton, const Joint& joint) {
  for (const Joint& next : skeleton.joints)
    if (next.parent == joint.child) return next.X_PJ.translation().normalized();
  const Segment& end = skeleton.segments[joint.child];
  if (withoutSide(end.name) == "foot") return Eigen::Vector3d::UnitX();
  return end.p_BCom.normalized();
}

void clearCellsBeyondEnvelope(const Skeleton& skeleton, const Joint& joint, RomMap& map) {
  for (int t = 0; t < RomMap::kTwists; ++t)
    for (int p = 0; p < RomMap::kPolars; ++p)
      for (int a = 0; a < RomMap::kAzimuths; ++a)
        if (auto& valid = map.valid[RomMap::cell(t, p, a)])
          valid = ballStopMargin_rad(skeleton, joint, map.R_JB(t, p, a)) >= -kTolerance_rad;
}

}  // namespace

// The most anterior (for the hand: palmar) direction normal to the shaft; a shaft that points forward itself has the
// superior one.
RomMapFrame romMapFrame(const Skeleton& skeleton, int joint) {
  const Eigen::Vector3d shaft = shaftOf(skeleton, skeleton.joints[joint]);
  const Eigen::Vector3d ahead = std::abs(shaft.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  return {shaft, (ahead - shaft * shaft.dot(ahead)).normalized()};
}

double RomMap::twist_rad(int twist) {
  return -kPi + (twist + 0.5) * (2 * kPi / kTwists);
}

Eigen::Vector3d RomMap::direction_J(int polar, int azimuth) const {
  const double theta = (polar + 0.5) * (kPi / kPolars), phi = (azimuth + 0.5) * (2 * kPi / kAzimuths);
  const Eigen::Vector3d aside = frame.shaft_J.cross(frame.forward_J);
  return std::cos(theta) * frame.shaft_J +
         std::sin(theta) * (std::cos(phi) * frame.forward_J + std::sin(phi) * aside);
}

Eigen::Matrix3d RomMap::swing_J(int polar, int azimuth) const {
  const Eigen::Vector3d axis = frame.shaft_J.cross(direction_J(polar, azimuth)).normalized();
  return rotationAbout<double>(axis, (polar + 0.5) * (kPi / kPolars));
}

Eigen::Matrix3d RomMap::R_JB(int twist, int polar, int azimuth) const {
  return swing_J(polar, azimuth) * rotationAbout<double>(frame.shaft_J, twist_rad(twist));
}

int RomMap::validCount() const {
  return static_cast<int>(std::ranges::count(valid, 1));
}

double RomMap::twistWidth_rad(int polar, int azimuth) const {
  int count = 0;
  for (int t = 0; t < kTwists; ++t) count += valid[cell(t, polar, azimuth)];
  return count * (2 * kPi / kTwists);
}

RomMap romMap(const Model& model, const std::string& joint_name, const Posture& held, const RomMapOptions& options) {
  const int joint = model.skeleton.jointIndex(joint_name);
  if (model.skeleton.joints[joint].type != JointType::Ball)
    throw InputError{{"range-of-motion map", "joint", "a ball-and-socket joint", "'" + joint_name + "'"}};
  require(held.size() == model.skeleton.coordinateCount(), "romMap: one entry a coordinate");
  RomMap map{joint_name, romMapFrame(model.skeleton, joint), {}};
  map.valid = cellsWithinMuscles(model, joint, held, map);
  if (options.joint_limits) clearCellsBeyondEnvelope(model.skeleton, model.skeleton.joints[joint], map);
  return map;
}

RomDifference compare(const RomMap& first, const RomMap& second) {
  if (first.joint != second.joint)
    throw InputError{{"range-of-motion map", "joint", "'" + first.joint + "' twice", "'" + second.joint + "'"}};
  RomDifference difference;
  for (int i = 0; i < RomMap::kCells; ++i) {
    difference.only_first += first.valid[i] && !second.valid[i];
    difference.only_second += second.valid[i] && !first.valid[i];
    difference.either += first.valid[i] || second.valid[i];
  }
  return difference;
}

}  // namespace sinew
