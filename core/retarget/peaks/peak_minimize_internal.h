#pragma once
#include <functional>
#include <vector>

#include "core/retarget/peaks/motion_torques_internal.h"
#include "core/retarget/peaks/peak_rows_internal.h"

namespace sinew {

/// A sum of squares of torques, and what changed ratios cost.
struct PeakObjective {
  std::function<std::vector<WeightedResiduals>(const MotionTorques::Table& torque_Nm)> residuals;
  double ratio_price = 0;     ///< of a squared relative change
  double largest_change = 0;  ///< of a ratio
  /// Whether a step may end there; may change what `residuals` gives. Empty: anywhere.
  std::function<bool(const MotionTorques::Table& torque_Nm)> allows;
};

/// Takes `state` to a minimum. Every iteration minimises the whole sum - whichever conditions are violated on the way
/// - for torques that are as straight as their slopes in `state`, and computes the torques there. Where that turns
/// out no better, the units whose torques bend most on the way are allowed less: one that slackens has an all but
/// upright curve there, the others are as straight as before. Stops when `goesOn`, asked before each iteration, says
/// no.
void minimize(MotionTorques& torques, MotionTorques::State& state, const PeakObjective& objective,
              const std::function<bool()>& goesOn);

}  // namespace sinew
