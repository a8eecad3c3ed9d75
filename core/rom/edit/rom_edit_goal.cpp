#include "core/kernel/batch.h"
#include "core/posture/validity.h"
#include "core/rom/edit/rom_edit_goal_internal.h"

namespace sinew {
namespace {

constexpr double kTolerance_rad = 1e-9;  // as maps have it

/// Cells whose image is within the reference's stops.
std::vector<std::uint8_t> wantedWithinStops(const Skeleton& skeleton, const RomTransform& transform,
                                            const JointCells& cells) {
  const int joint = cells.joint();
  const Joint& j = skeleton.joints[joint];
  const RomMap map{j.name, romMapFrame(skeleton, joint), {}};
  std::vector<std::optional<double>> twists;
  for (int t = 0; t < RomMap::kTwists; ++t) twists.push_back(transform.twist(joint, RomMap::twist_rad(t)));
  std::vector<std::uint8_t> wanted(cells.cellCount(), 0);
  for (int p = 0; p < RomMap::kPolars; ++p)
    for (int a = 0; a < RomMap::kAzimuths; ++a) {
      const auto v = transform.direction(joint, map.direction_J(p, a));
      if (!v) continue;
      const Eigen::Matrix3d swing = swingTo(map.frame.shaft_J, *v).toRotationMatrix();
      for (int t = 0; t < RomMap::kTwists; ++t)
        if (twists[t])
          wanted[RomMap::cell(t, p, a)] =
              ballStopMargin_rad(skeleton, j, swing * rotationAbout<double>(map.frame.shaft_J, *twists[t])) >=
              -kTolerance_rad;
    }
  return wanted;
}

JointGoal ballGoal(const Model& reference, const RomTransform& transform, const JointCells& cells) {
  const int joint = cells.joint();
  JointGoal goal{.cells = &cells};
  for (const HeldPosture& held : cells.held()) {
    const RomMap map = editedRomMap(reference, transform, reference.skeleton.joints[joint].name, held.posture,
                                    {.joint_limits = false});
    goal.muscles.insert(goal.muscles.end(), map.valid.begin(), map.valid.end());
  }
  goal.stops = wantedWithinStops(reference.skeleton, transform, cells);
  return goal;
}

/// Lengths of the images of a hinge's cells against the reference's longest ones.
void judgeHinge(const Model& reference, const RomTransform& transform, JointGoal& goal) {
  const JointCells& cells = *goal.cells;
  const int first = reference.skeleton.joints[cells.joint()].first_coordinate;
  std::vector<Posture> images;
  std::vector<bool> has_image;
  for (const HeldPosture& held : cells.held())
    for (std::size_t i = 0; i < cells.cellCount(); ++i) {
      Posture q = held.posture;
      q[first] = cells.angle_rad(i);
      const auto image = transform.apply(q);
      has_image.push_back(image.has_value());
      images.push_back(image.value_or(q));
    }
  PoseTable lengths_m;
  batchLengths(cells.compiled(), PoseTable{images}, lengths_m);
  const auto longest_m = cells.compiled().longest_m();
  for (std::size_t s = 0; s < images.size(); ++s) {
    bool valid = has_image[s];
    for (std::size_t u = 0; u < longest_m.size() && valid; ++u) valid = lengths_m(s, u) <= longest_m[u];
    goal.muscles.push_back(valid);
  }
}

JointGoal hingeGoal(const Model& reference, const RomTransform& transform, const JointCells& cells) {
  JointGoal goal{.cells = &cells, .hinge = editedStops(reference.skeleton, transform, cells.joint())};
  judgeHinge(reference, transform, goal);
  for (std::size_t i = 0; i < cells.cellCount(); ++i)
    goal.stops.push_back(cells.angle_rad(i) >= goal.hinge.min_rad && cells.angle_rad(i) <= goal.hinge.max_rad);
  return goal;
}

}  // namespace

JointGoal goalOf(const Model& reference, const RomTransform& transform, const JointCells& cells) {
  return cells.isBall() ? ballGoal(reference, transform, cells) : hingeGoal(reference, transform, cells);
}

}  // namespace sinew
