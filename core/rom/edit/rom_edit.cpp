#include "core/rom/edit/rom_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/error.h"
#include "core/rom/maps/rom_map.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAlongShaft =
    0.9;  // cosine beyond which an axis turns about the shaft, or a direction is the shaft's

Eigen::Vector3d vectorOf(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

/// Directions by name, as the joint's side sees them; nullopt-like zero for none.
std::vector<std::pair<std::string, Eigen::Vector3d>> directionsOf(const Joint& joint) {
  using V = Eigen::Vector3d;
  std::vector<std::pair<std::string, V>> all = {
      {"forward", V::UnitX()}, {"backward", -V::UnitX()}, {"up", V::UnitY()}, {"down", -V::UnitY()}};
  const bool sided = joint.name.ends_with("_r") || joint.name.ends_with("_l");
  const double outward = joint.name.ends_with("_l") ? -1 : 1;
  all.emplace_back(sided ? "outward" : "right", outward * V::UnitZ());
  all.emplace_back(sided ? "inward" : "left", -outward * V::UnitZ());
  return all;
}

/// Unit axes of the tilts that this joint knows by name.
std::vector<std::pair<std::string, Eigen::Vector3d>> namedAxes(const Skeleton& skeleton, int joint) {
  const Joint& j = skeleton.joints[joint];
  const Eigen::Vector3d shaft = romMapFrame(skeleton, joint).shaft_J;
  std::vector<std::pair<std::string, Eigen::Vector3d>> axes;
  for (const auto& [name, direction] : directionsOf(j))
    if (std::abs(shaft.dot(direction)) < kAlongShaft) axes.emplace_back(name, shaft.cross(direction).normalized());
  for (int i = j.first_coordinate; i < j.first_coordinate + j.coordinate_count; ++i) {
    const Coordinate& c = skeleton.coordinates[i];
    if (std::abs(shaft.dot(c.axis)) < kAlongShaft) axes.emplace_back(withoutSide(c.name), c.axis);
  }
  return axes;
}

void checkFactor(double factor, const char* field, const std::string& where) {
  if (!(factor >= kLeastRomFactor && factor <= kMostRomFactor)) {
    throw InputError{{where, field, "a factor from 0.05 to 5", brief(factor)}};
  }
}

void checkAngle(double angle_rad, const char* field, const std::string& where) {
  if (!(std::abs(angle_rad) <= kPi)) {
    throw InputError{{where, field, "an angle from -180 to 180 degrees", brief(angle_rad * 180 / kPi)}};
  }
}

void checkHinge(const RomEdit& e, const std::string& where) {
  if (e.cone_factor != 1 || e.tilt.angle_rad != 0 || e.twist_factor != 1 || e.twist_shift_rad != 0)
    throw InputError{{where, e.joint, "scale and shift: it is a hinge", "cone, tilt or twist"}};
  checkFactor(e.range_factor, "scale", where);
  checkAngle(e.shift_rad, "shift", where);
}

void checkBall(const Skeleton& skeleton, int joint, const RomEdit& e, const std::string& where) {
  if (e.range_factor != 1 || e.shift_rad != 0)
    throw InputError{{where, e.joint, "cone, tilt and twist: it is a ball joint", "scale or shift"}};
  checkFactor(e.cone_factor, "cone", where);
  checkFactor(e.twist_factor, "twist scale", where);
  checkAngle(e.twist_shift_rad, "twist shift", where);
  checkAngle(e.tilt.angle_rad, "tilt", where);
  tiltVector_J(skeleton, joint, e.tilt, where);
}

}  // namespace

bool RomEdit::isIdentity() const {
  return range_factor == 1 && shift_rad == 0 && cone_factor == 1 && tilt.angle_rad == 0 && twist_factor == 1 &&
         twist_shift_rad == 0;
}

bool isIdentity(const RomEdits& edits) {
  return std::ranges::all_of(edits, &RomEdit::isIdentity);
}

Eigen::Vector3d tiltVector_J(const Skeleton& skeleton, int joint, const RomTilt& tilt, const std::string& where) {
  if (tilt.angle_rad == 0) return Eigen::Vector3d::Zero();
  if (tilt.towards.empty()) {
    const Eigen::Vector3d axis = vectorOf(tilt.axis_J);
    if (!axis.allFinite() || axis.norm() < 1e-6) throw InputError{{where, "tilt", "a direction or an axis", "none"}};
    return tilt.angle_rad * axis.normalized();
  }
  const auto axes = namedAxes(skeleton, joint);
  const auto found = std::ranges::find(axes, tilt.towards, &std::pair<std::string, Eigen::Vector3d>::first);
  if (found != axes.end()) return tilt.angle_rad * found->second;
  std::vector<std::string> known;
  std::string list;
  for (const auto& [name, axis] : axes) {
    known.push_back(name);
    list += (list.empty() ? "" : ", ") + name;
  }
  throw InputError{{where, "tilt of " + skeleton.joints[joint].name, list,
                    "'" + tilt.towards + "'" + didYouMean(tilt.towards, known)}};
}

void checkRomEdits(const Skeleton& skeleton, const RomEdits& edits, const std::string& where) {
  for (const RomEdit& e : edits) {
    const auto joint = std::ranges::find(skeleton.joints, e.joint, &Joint::name);
    if (joint == skeleton.joints.end() || joint->type == JointType::Free) {
      std::vector<std::string> names;
      for (const Joint& j : skeleton.joints)
        if (j.type != JointType::Free) names.push_back(j.name);
      throw InputError{{where, "joint", "a joint of the model", "'" + e.joint + "'" + didYouMean(e.joint, names)}};
    }
    if (joint->type == JointType::Revolute)
      checkHinge(e, where);
    else
      checkBall(skeleton, static_cast<int>(joint - skeleton.joints.begin()), e, where);
  }
}

int twistSign(const Skeleton& skeleton, int joint) {
  const Eigen::Vector3d shaft = romMapFrame(skeleton, joint).shaft_J;
  const Joint& j = skeleton.joints[joint];
  double most = 0;
  for (int i = j.first_coordinate; i < j.first_coordinate + j.coordinate_count; ++i)
    if (const double along = skeleton.coordinates[i].axis.dot(shaft); std::abs(along) > std::abs(most)) most = along;
  return most < 0 ? -1 : 1;
}

std::string inWords(const RomEdit& e) {
  std::string words;
  const auto add = [&](std::string part) { words += (words.empty() ? "" : ", ") + std::move(part); };
  constexpr double kDeg = 180 / kPi;
  if (e.range_factor != 1) add(fmt::format("range x {:.3g}", e.range_factor));
  if (e.shift_rad != 0) add(fmt::format("shifted {:+.3g} deg", e.shift_rad * kDeg));
  if (e.cone_factor != 1) add(fmt::format("cone x {:.3g}", e.cone_factor));
  if (e.tilt.angle_rad != 0) {
    add(fmt::format("tilted {:.3g} deg ", e.tilt.angle_rad * kDeg));
    words += e.tilt.towards.empty() ? "about an axis" : e.tilt.towards;
  }
  if (e.twist_factor != 1) add(fmt::format("twist x {:.3g}", e.twist_factor));
  if (e.twist_shift_rad != 0) add(fmt::format("twist shifted {:+.3g} deg", e.twist_shift_rad * kDeg));
  return e.joint + ": " + (words.empty() ? "unchanged" : words);
}

}  // namespace sinew
