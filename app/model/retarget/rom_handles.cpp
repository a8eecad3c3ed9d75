#include "app/model/retarget/rom_handles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Matrix3d tiltOf(const RomEdit& edit, const Skeleton& skeleton) {
  const int joint = skeleton.jointIndex(edit.joint);
  const Eigen::Vector3d v = tiltVector_J(skeleton, joint, edit.tilt, "tilt");
  return v.isZero(0) ? Eigen::Matrix3d::Identity() : Eigen::AngleAxisd{v.norm(), v.normalized()}.toRotationMatrix();
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Factor and shift that take an interval about `centre` to another one.
struct Scaled {
  double factor, shift_rad;
};
Scaled scaledTo(double centre, double low, double high, double wanted_low, double wanted_high) {
  const double width = std::max(1e-6, high - low);
  const double factor = std::clamp((wanted_high - wanted_low) / width, kLeastRomFactor, kMostRomFactor);
  const double middle = (wanted_low + wanted_high) / 2, scaled_middle = centre + factor * ((low + high) / 2 - centre);
  return {factor, std::clamp(middle - scaled_middle, -kPi, kPi)};
}

/// Rounded as a person would say it: hands are not that steady, and figures stay readable.
double rounded(double value, double step) {
  return std::round(value / step) * step;
}
constexpr double kFactorStep = 0.01, kAngleStep_rad = kPi / 360;

}  // namespace

BallRange ballRange(const RomMap& map, const RomCentres& centres, int joint) {
  BallRange range;
  range.centre_J = centres.direction_J[std::size_t(joint)];
  range.twist_centre_rad = centres.twist_rad[std::size_t(joint)];
  double area = 0;
  constexpr double kStep_rad = kPi / RomMap::kPolars;
  std::vector<bool> used(RomMap::kTwists, false);
  for (int p = 0; p < RomMap::kPolars; ++p)
    for (int a = 0; a < RomMap::kAzimuths; ++a) {
      bool open = false;
      for (int t = 0; t < RomMap::kTwists; ++t)
        if (map.valid[std::size_t(RomMap::cell(t, p, a))]) open = used[std::size_t(t)] = true;
      if (open) area += (std::cos(p * kStep_rad) - std::cos((p + 1) * kStep_rad)) * 2 * kPi / RomMap::kAzimuths;
    }
  range.cone_rad = std::acos(std::clamp(1 - area / (2 * kPi), -1.0, 1.0));
  const double half_cell_rad = kPi / RomMap::kTwists;
  range.twist_low_rad = range.twist_high_rad = range.twist_centre_rad;
  for (int t = 0; t < RomMap::kTwists; ++t) {
    if (!used[std::size_t(t)]) continue;
    range.twist_low_rad = std::min(range.twist_low_rad, RomMap::twist_rad(t) - half_cell_rad);
    range.twist_high_rad = std::max(range.twist_high_rad, RomMap::twist_rad(t) + half_cell_rad);
  }
  return range;
}

HingeRange hingeRange(const Skeleton& skeleton, const RomCentres& centres, int joint) {
  const Coordinate& c = skeleton.coordinates[std::size_t(skeleton.joints[std::size_t(joint)].first_coordinate)];
  return {centres.angle_rad[std::size_t(joint)], c.stop_min_rad, c.stop_max_rad};
}

BallRange edited(const BallRange& before, const RomEdit& edit, const Skeleton& skeleton) {
  const double shift_rad = edit.twist_shift_rad * twistSign(skeleton, skeleton.jointIndex(edit.joint));
  const auto twist = [&](double t) {
    return std::clamp(before.twist_centre_rad + edit.twist_factor * (t - before.twist_centre_rad) + shift_rad, -kPi,
                      kPi);
  };
  BallRange after;
  after.centre_J = tiltOf(edit, skeleton) * before.centre_J;
  after.cone_rad = std::min(kPi, edit.cone_factor * before.cone_rad);
  after.twist_centre_rad = before.twist_centre_rad + shift_rad;
  after.twist_low_rad = twist(before.twist_low_rad);
  after.twist_high_rad = twist(before.twist_high_rad);
  return after;
}

HingeRange edited(const HingeRange& before, const RomEdit& edit) {
  const auto moved = [&](double angle) {
    return before.centre_rad + edit.range_factor * (angle - before.centre_rad) + edit.shift_rad;
  };
  return {before.centre_rad + edit.shift_rad, moved(before.low_rad), moved(before.high_rad)};
}

const RomEdit* findEdit(const RomEdits& edits, const std::string& joint) {
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
    if (edit->joint == joint) return &*edit;
  return nullptr;
}

RomEdit& editOf(RomEdits& edits, const std::string& joint) {
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
    if (edit->joint == joint) return *edit;
  edits.push_back({.joint = joint});
  return edits.back();
}

void dropIdentities(RomEdits& edits) {
  std::erase_if(edits, [](const RomEdit& e) { return e.isIdentity(); });
}

RomEdits editsBefore(const RomEdits& edits, const std::string& joint) {
  RomEdits before = edits;
  if (const RomEdit* last = findEdit(edits, joint)) before.erase(before.begin() + (last - edits.data()));
  return before;
}

void pullCentre(const BallRange& before, const Eigen::Vector3d& direction_J, RomEdit& edit) {
  const double angle_rad = rounded(angleBetween(before.centre_J, direction_J), kAngleStep_rad);
  edit.tilt = {};
  if (angle_rad == 0) return;
  const Eigen::Vector3d axis = before.centre_J.cross(direction_J).normalized();
  if (!axis.allFinite()) return;
  edit.tilt.axis_J = {axis.x(), axis.y(), axis.z()};
  edit.tilt.angle_rad = std::min(angle_rad, kPi);
}

void pullBorder(const BallRange& before, const Eigen::Vector3d& direction_J, const Skeleton& skeleton,
                RomEdit& edit) {
  if (!(before.cone_rad > 0)) return;
  const double radius_rad = angleBetween(tiltOf(edit, skeleton) * before.centre_J, direction_J);
  edit.cone_factor = std::clamp(rounded(radius_rad / before.cone_rad, kFactorStep), kLeastRomFactor, kMostRomFactor);
}

void setTwist(const BallRange& before, double low_rad, double high_rad, int twist_sign, RomEdit& edit) {
  const Scaled s = scaledTo(before.twist_centre_rad, before.twist_low_rad, before.twist_high_rad, low_rad, high_rad);
  edit.twist_factor = std::max(kLeastRomFactor, rounded(s.factor, kFactorStep));
  edit.twist_shift_rad = twist_sign * rounded(s.shift_rad, kAngleStep_rad);
}

void setHinge(const HingeRange& before, double low_rad, double high_rad, RomEdit& edit) {
  const Scaled s = scaledTo(before.centre_rad, before.low_rad, before.high_rad, low_rad, high_rad);
  edit.range_factor = std::max(kLeastRomFactor, rounded(s.factor, kFactorStep));
  edit.shift_rad = rounded(s.shift_rad, kAngleStep_rad);
}

}  // namespace sinew
