#pragma once
#include <string>
#include <vector>

#include "core/model/model.h"
#include "core/retarget/prepared/routing_reference.h"

namespace sinew {

class RetargetReference;
struct Retargeted;

/// How the function of one unit changed in a new body: what the inspector lists.
struct MuscleChange {
  int unit = -1;
  double energy_naive = 0, energy = 0;  ///< routing energy with points moved with the bones, and retargeted
  /// Joint motions in which it lengthens somewhere where the reference's shortens, or the other way round.
  int reversals_naive = 0, reversals = 0;
  int motions = 0;            ///< that it takes part in
  double length_factor = 1;   ///< fibre and tendon over the reference's
  double ratio_factor = 1;    ///< fibre : tendon over the reference's
  double largest_move_m = 0;  ///< of a path point, against moving with its bone
  /// Angle of peak torque against the reference's, of the motion where it is furthest off: with the reference's
  /// fibre : tendon ratios, and optimised. Of all muscles of the motion together.
  std::string peak_motion;
  double peak_before_deg = 0, peak_after_deg = 0;
  double rom_factor = 1;  ///< further change of its length by edits of ranges of motion
};

/// By unit. `naive`: deformedModel(); `retargeted` includes its model.
std::vector<MuscleChange> muscleChanges(const RetargetReference& reference, const Model& naive,
                                        const Retargeted& retargeted);

/// Where a unit lengthens against the reference, by motion that it takes part in; 0 or 1.
std::vector<int> reversedMotions(const RetargetReference& reference, const MotionPoses& poses,
                                 const Musculature& musculature, std::size_t unit);

}  // namespace sinew
