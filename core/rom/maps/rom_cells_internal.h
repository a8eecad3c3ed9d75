#pragma once
#include <cstdint>
#include <vector>

#include "core/rom/maps/rom_map.h"

namespace sinew {

/// Units whose length changes with this joint: their anchors do not all move alike.
std::vector<int> unitsSpanning(const Skeleton& skeleton, const Musculature& musculature, int joint);

/// The same of any joint; a hinge's are those whose length changes with it where it is 0 (the patella moves with it).
std::vector<int> unitsOverJoint(const Model& model, int joint);

/// Whether the units that span a joint allow an orientation of it: the readable way, through the kinematics of a
/// whole posture, in double. Decides what is close; oracle of the fast way.
class CellJudge {
 public:
  CellJudge(const Model& model, int joint, const Posture& held);
  const std::vector<int>& units() const { return units_; }
  bool allows(const Eigen::Matrix3d& R_JB);

 private:
  const Model& model_;
  std::vector<int> units_;
  Posture posture_;
  int first_coordinate_;
};

/// 1 for every cell of the map's grid in which no unit that spans the joint is beyond its longest length. Fast: see
/// core/kernel/joint_grid.h.
std::vector<std::uint8_t> cellsWithinMuscles(const Model& model, int joint, const Posture& held, const RomMap& map);

}  // namespace sinew
