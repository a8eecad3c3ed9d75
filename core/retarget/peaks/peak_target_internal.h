#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "core/retarget/peaks/peak_condition_internal.h"
#include "core/retarget/peaks/peak_torque.h"

namespace sinew {

/// What is left of one motion, to be squared, and its slopes with three torques.
struct TorqueResidual {
  double value = 0;
  std::array<int, 3> sample{};
  std::array<double, 3> slope_1_Nm{};
};
using TorqueResiduals = std::vector<TorqueResidual>;
double energyOf(const TorqueResiduals& residuals);  ///< sum of squares

/// One motion with an angle of peak torque to reach.
class PeakTarget {
 public:
  /// `first_Nm`: torques before anything is changed.
  PeakTarget(std::size_t motion, const JointMotion& what, double wanted_theta,
             const Eigen::Ref<const MotionTorques::Samples>& first_Nm);

  std::size_t motion() const { return motion_; }
  double wantedTheta() const { return wanted_theta_; }
  /// theta - wanted; 1 for a motion that nothing drives any more.
  double off(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm) const;
  double off_deg(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm) const {
    return std::abs(off(torque_Nm)) * span_deg_;
  }
  bool isWithin(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm) const {
    return off_deg(torque_Nm) <= kPeakTorqueTarget_deg;
  }

  /// How near the peak has to be for its conditions to hold.
  void setTolerance(double tolerance_deg);
  /// What of the conditions does not hold, in shares of the greatest torque at first; of the alternatives the one
  /// that is least off.
  TorqueResiduals violations(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm) const;
  /// off(), as long as the peak stays beside its sample.
  TorqueResiduals deviation(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm) const;

 private:
  std::size_t motion_;
  double wanted_theta_, span_deg_, scale_Nm_;
  struct Wanted {
    TorqueCondition condition;
    double by;  ///< how much it has to hold, in shares of the greatest torque at first
  };
  std::vector<std::vector<Wanted>> alternatives_;
};

}  // namespace sinew
