#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/kernel/isa.h"
#include "core/muscle/musculature.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

/// How a segment moves when one joint turns.
enum class JointMotionKind {
  Fixed,
  WithChild,
  WithRadius  ///< turns with the axial part of the wrist alone
};
/// By segment.
std::vector<JointMotionKind> motionsWithJoint(const Skeleton& skeleton, int joint);

/// Orientations of one ball joint to be judged: every twist with every swing, R_JB = swing * twist.
struct JointGrid {
  std::span<const Eigen::Matrix3d> twists, swings;  ///< number of swings: a multiple of 16
};

/// Whether the units allow an orientation, in single precision.
enum class GridVerdict : std::uint8_t {
  Forbidden,  ///< a unit is beyond its longest length
  Allowed,
  Close  ///< none is beyond by more than 5 um, but one is within 5 um of it: to be decided in double
};

/// Verdict on every cell [twist][swing], given that only these units (those that span the joint) count and all other
/// coordinates stay as in `held`.
std::vector<GridVerdict> judgeGrid(const Skeleton& skeleton, const Musculature& musculature,
                                   std::span<const int> units, int joint, const Posture& held, const JointGrid& grid,
                                   Isa isa = chosenIsa());

}  // namespace sinew
