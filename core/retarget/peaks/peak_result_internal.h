#pragma once
#include <Eigen/Core>

#include "core/retarget/peaks/peak_torque.h"

namespace sinew {

void setRatios(Musculature& musculature, const Eigen::VectorXd& ratio);

/// `before`, `after`: peakTheta() by motion.
PeakTorqueResult peakTorqueResult(const std::vector<JointMotion>& motions, const std::vector<double>& wanted_theta,
                                  const std::vector<double>& before, const std::vector<double>& after,
                                  const Eigen::VectorXd& ratio, int iterations);

}  // namespace sinew
