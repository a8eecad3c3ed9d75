#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/retarget/ratio_force_internal.h"
#include "core/retarget/torque_geometry.h"

namespace sinew {

/// Torques of all motions as functions of the units' fibre : tendon ratios (1: those of the musculature).
class MotionTorques {
 public:
  using Samples = Eigen::Matrix<double, TorqueGeometry::kSamples, 1>;

  /// What one unit does in one motion, by sample.
  struct Share {
    Samples torque_Nm = Samples::Zero(), slope_Nm = Samples::Zero();  ///< slope: with the ratio
    Samples fiber = Samples::Zero();  ///< normalised length found: where the next search starts; 0: nothing known
  };
  /// All torques at some ratios.
  struct State {
    Eigen::VectorXd ratio;
    std::vector<Samples> torque_Nm;          ///< by motion
    std::vector<std::vector<Share>> shares;  ///< by motion and TorqueGeometry::unitsOf()
  };
  MotionTorques(const TorqueGeometry& geometry, const Musculature& musculature);
  const TorqueGeometry& geometry() const { return geometry_; }
  std::size_t unitCount() const { return forces_.size(); }

  State original();
  /// Takes `state` to other ratios; only what depends on a changed one is computed.
  void move(State& state, const Eigen::VectorXd& ratio);

 private:
  void sweep(UnitPart part, Share& share) const;

  const TorqueGeometry& geometry_;
  std::vector<RatioForce> forces_;  ///< by unit, at the ratio set last
  std::vector<std::vector<UnitPart>> parts_;
};

/// peakTheta() of one motion.
double peakTheta(const MotionTorques::Samples& torque_Nm);

}  // namespace sinew
