#pragma once
#include <array>
#include <vector>

#include "core/retarget/peaks/motion_torques_internal.h"

namespace sinew {

/// A linear condition on the torques of one motion: the weighted sum of three samples is not negative.
struct TorqueCondition {
  std::array<int, 3> sample{};
  std::array<double, 3> weight{};

  bool isSlope() const { return weight[2] != 0; }  ///< else a difference of the first two samples
  double of(const Eigen::Ref<const Eigen::VectorXd>& torque_Nm) const {
    return weight[0] * torque_Nm[sample[0]] + weight[1] * torque_Nm[sample[1]] + weight[2] * torque_Nm[sample[2]];
  }
};

/// The conditions that together say: the highest sample is `sample`, and the peak beside it lies within
/// [low, high] (in samples, as are all places). Empty if a peak there lies outside.
std::vector<TorqueCondition> peakConditions(int sample, double low, double high);

/// peakTheta() lies within [low, high] exactly if all conditions of one of these hold.
std::vector<std::vector<TorqueCondition>> peakAlternatives(double low, double high);

/// The same for `tolerance_deg` on both sides of a theta in [0, 1], of a motion that goes through `span_deg`.
std::vector<std::vector<TorqueCondition>> peakAlternatives(double wanted_theta, double tolerance_deg,
                                                           double span_deg);

}  // namespace sinew
