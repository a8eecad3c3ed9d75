#pragma once
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/model/path_clearance.h"

namespace sinew {

/// Where do bones run into one another? Two bones of different segments that are apart when standing but more than
/// `depth_m` in one another in a posture: no body can take it, and no path between them can run outside both. Bones
/// that are nearer than `depth_m` when standing meet in a joint and do not count. Found at the meshes' vertices.
class BoneContacts {
 public:
  /// The arguments must outlive this.
  BoneContacts(const Model& model, const BoneDistances& bones, std::span<const Posture> postures,
               double depth_m = 0.002);

  /// Indices of the postures in which the bones that the unit spans are apart.
  std::vector<int> posturesWithBonesApart(const MusculotendonUnit& unit);

 private:
  bool comeWithin(std::size_t bone, std::size_t other, const std::vector<RigidTransform>& X_WB, double gap_m) const;
  const std::vector<bool>& collisions(int segment, int other);

  const Model& model_;
  const BoneDistances& bones_;
  double depth_m_;
  std::vector<RigidTransform> standing_X_WB_;
  std::vector<std::vector<RigidTransform>> X_WB_;  ///< by posture
  std::map<std::pair<int, int>, std::vector<bool>> by_segments_;
};

}  // namespace sinew
