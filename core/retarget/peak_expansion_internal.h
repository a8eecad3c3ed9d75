#pragma once
#include <vector>

#include "core/retarget/motion_torques_internal.h"
#include "core/retarget/peak_target_internal.h"

namespace sinew {

/// Residuals of one motion.
struct WeightedResiduals {
  std::size_t motion = 0;
  double weight = 1;
  TorqueResiduals residuals;
};

/// Gauss-Newton expansion of the weighted sum of squares and the price of ratios, by the ratios of the units that
/// turn a motion with residuals.
struct PeakExpansion {
  std::vector<int> units;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};

double energyOf(const std::vector<WeightedResiduals>& list, const Eigen::VectorXd& ratio, double ratio_price);
PeakExpansion expansionOf(const std::vector<WeightedResiduals>& list, const MotionTorques& torques,
                          const MotionTorques::State& state, double ratio_price);

}  // namespace sinew
