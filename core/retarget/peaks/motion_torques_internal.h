#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/retarget/peaks/ratio_force_internal.h"
#include "core/retarget/prepared/torque_geometry.h"

namespace sinew {

/// Torques of all motions as functions of the units' fibre : tendon ratios (1: those of the musculature).
class MotionTorques {
 public:
  using Samples = Eigen::Matrix<double, TorqueGeometry::kSamples, 1>;
  using Table = Eigen::Matrix<double, TorqueGeometry::kSamples, Eigen::Dynamic>;  ///< a column for every motion

  /// What one unit does in one motion, by sample.
  struct Share {
    Samples torque_Nm = Samples::Zero(), slope_Nm = Samples::Zero();  ///< slope: with the ratio
    double ratio = 1;                                                 ///< that this is for
    /// Normalised fibre length found, and its slope with the ratio: where the next search starts; 0: nothing known.
    Samples fiber = Samples::Zero(), fiber_slope = Samples::Zero();
  };
  /// All torques at some ratios.
  struct State {
    Eigen::VectorXd ratio;
    Table torque_Nm;
    std::vector<Share> shares;  ///< at sharesOf() a motion, in the order of TorqueGeometry::unitsOf()
  };
  MotionTorques(const TorqueGeometry& geometry, const Musculature& musculature);
  const TorqueGeometry& geometry() const { return geometry_; }
  std::size_t unitCount() const { return forces_.size(); }
  std::size_t sharesOf(std::size_t motion) const { return first_share_[motion]; }

  State original();
  /// Takes `state` to other ratios; only what depends on a changed one is computed.
  void move(State& state, const Eigen::VectorXd& ratio);
  /// What torques change by if ratios change by so much, were they as straight as their slopes are in `state`.
  void differential(const State& state, const Eigen::VectorXd& change, Table& torque_Nm) const;
  /// By unit: how far its torques in `to` are from what slopes in `from` say, at most, in shares of the motion's.
  Eigen::VectorXd bends(const State& from, const State& to) const;

 private:
  void sweep(UnitPart part, double ratio, Share& share) const;

  const TorqueGeometry& geometry_;
  std::vector<RatioForce> forces_;  ///< by unit, at the ratio set last
  std::vector<std::vector<UnitPart>> parts_;
  std::vector<std::size_t> first_share_;  ///< by motion; one more behind the last
};

/// peakTheta() of one motion.
double peakTheta(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm);

}  // namespace sinew
