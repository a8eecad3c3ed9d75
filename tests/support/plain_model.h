#pragma once
#include <memory>
#include <string>

#include "core/model/model.h"
#include "tests/support/resources.h"
#include "tests/support/shapes.h"

namespace sinew::test {

inline void addBone(std::vector<BoneMesh>& bones, const Skeleton& skeleton, const std::string& segment,
                    const Eigen::Vector3d& from, const Eigen::Vector3d& to, double thickness_m) {
  const Eigen::Vector3d half{thickness_m / 2, (from - to).norm() / 2, thickness_m / 2};
  bones.push_back({segment, skeleton.segmentIndex(segment), ellipsoid(half, (from + to) / 2, 20)});
}

inline Anchor anchorOn(const Skeleton& skeleton, const std::string& segment, const Eigen::Vector3d& p_B) {
  return {skeleton.segmentIndex(segment), 1, p_B};
}

/// The real skeleton with ellipsoids for the bones of the legs and one straight muscle a leg, in front of the femur:
/// enough to know beforehand what a picture must show.
inline Model plainModel() {
  Model model;
  model.name = "plain";
  model.skeleton = loadReferenceSkeleton(resourceDir());
  auto bones = std::make_shared<std::vector<BoneMesh>>();
  const Skeleton& s = model.skeleton;
  addBone(*bones, s, "pelvis", {0, 0.09, 0}, {0, -0.03, 0}, 0.16);
  for (const std::string side : {"_r", "_l"}) {
    addBone(*bones, s, "femur" + side, {0, 0.02, 0}, {0, -0.43, 0}, 0.05);
    addBone(*bones, s, "tibia" + side, {0, 0, 0}, {0, -0.43, 0}, 0.045);
    addBone(*bones, s, "foot" + side, {0.05, 0.02, 0}, {0.05, -0.06, 0}, 0.08);
    MusculotendonUnit unit;
    unit.name = "front_of_thigh" + side;
    unit.group = "quadriceps";
    unit.max_isometric_force_N = 1500;
    unit.optimal_fiber_length_m = 0.2;
    unit.tendon_slack_length_m = 0.1;
    unit.path = {{PathPointRole::Origin, {anchorOn(s, "femur" + side, {0.06, -0.05, 0})}, "femur", "front"},
                 {PathPointRole::Insertion, {anchorOn(s, "femur" + side, {0.06, -0.38, 0})}, "femur", "front"}};
    model.musculature.units.push_back(unit);
  }
  model.bones = bones;
  return model;
}

}  // namespace sinew::test
