#pragma once
#include <deque>
#include <vector>

#include "core/rom/edit/rom_edit_goal_internal.h"

namespace sinew {

/// Columns of all edited joints side by side: a unit that spans two of them has the samples of both.
struct JoinedProblem {
  std::vector<int> units;
  std::deque<ThresholdColumn> merged;  ///< of units that span more than one, or not the first
  ThresholdProblem problem;
};

/// Wrong cells within the new stops count the weight of their posture, those by which the muscles alone are wrong
/// `weight_alone` of it.
JoinedProblem joinedProblem(const std::vector<JointGoal>& goals, double weight_alone);

}  // namespace sinew
