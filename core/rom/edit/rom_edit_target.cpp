#include "core/rom/edit/rom_edit_target.h"

#include <algorithm>

#include "core/error.h"
#include "core/kernel/joint_grid.h"
#include "core/rom/maps/rom_cells_internal.h"

namespace sinew {
namespace {

/// The map's cells as T sees them: twists and directions of their own; those without an image are marked.
struct TransformedGrid {
  std::vector<Eigen::Matrix3d> twists, swings;
  std::vector<bool> has_twist, has_swing;
};

TransformedGrid transformedGrid(const RomTransform& transform, int joint, const RomMap& map) {
  TransformedGrid grid;
  for (int t = 0; t < RomMap::kTwists; ++t) {
    const auto twist = transform.twist(joint, RomMap::twist_rad(t));
    grid.has_twist.push_back(twist.has_value());
    grid.twists.push_back(rotationAbout<double>(map.frame.shaft_J, twist.value_or(0)));
  }
  for (int p = 0; p < RomMap::kPolars; ++p)
    for (int a = 0; a < RomMap::kAzimuths; ++a) {
      const auto v = transform.direction(joint, map.direction_J(p, a));
      grid.has_swing.push_back(v.has_value());
      grid.swings.push_back(swingTo(map.frame.shaft_J, v.value_or(map.frame.shaft_J)).toRotationMatrix());
    }
  return grid;
}

}  // namespace

std::optional<Validity> editedValidity(const Model& reference, const RomTransform& transform, const Posture& q) {
  const auto image = transform.apply(q);
  if (!image) return std::nullopt;
  return validity(reference.skeleton, reference.musculature, *image);
}

RomMap editedRomMap(const Model& reference, const RomTransform& transform, const std::string& joint_name,
                    const Posture& held, const RomMapOptions& options) {
  const int joint = reference.skeleton.jointIndex(joint_name);
  const Joint& j = reference.skeleton.joints[joint];
  if (j.type != JointType::Ball)
    throw InputError{{"range-of-motion map", "joint", "a ball-and-socket joint", "'" + joint_name + "'"}};
  RomMap map{joint_name, romMapFrame(reference.skeleton, joint), std::vector<std::uint8_t>(RomMap::kCells, 0)};
  const auto image = transform.apply(held, joint);
  if (!image) return map;
  const TransformedGrid grid = transformedGrid(transform, joint, map);
  CellJudge judge{reference, joint, *image};
  const auto verdicts =
      judgeGrid(reference.skeleton, reference.musculature, judge.units(), joint, *image, {grid.twists, grid.swings});
  const std::size_t swings = grid.swings.size();
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (!grid.has_twist[i / swings] || !grid.has_swing[i % swings]) continue;
    if (verdicts[i] == GridVerdict::Forbidden) continue;
    const Eigen::Matrix3d R_JB = grid.swings[i % swings] * grid.twists[i / swings];
    bool valid = verdicts[i] == GridVerdict::Allowed || judge.allows(R_JB);
    if (valid && options.joint_limits) valid = ballStopMargin_rad(reference.skeleton, j, R_JB) >= -1e-9;
    map.valid[i] = valid;
  }
  return map;
}

HingeStops editedStops(const Skeleton& reference, const RomTransform& transform, int joint) {
  const Coordinate& c = reference.coordinates[reference.joints[joint].first_coordinate];
  return {transform.hingeInverse(joint, c.stop_min_rad), transform.hingeInverse(joint, c.stop_max_rad)};
}

}  // namespace sinew
