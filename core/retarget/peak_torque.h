#pragma once
#include <string>
#include <vector>

#include "core/job.h"
#include "core/kernel/pose_table.h"
#include "core/model/model.h"
#include "core/skeleton/joint_motion.h"

namespace sinew {

// Step 3 of retargeting (Ryu et al., Angle of Peak Torque): fibre : tendon ratios within 30 % of the reference's, the
// longest length kept, so that every joint motion has its greatest torque at the same angle as in the reference. The
// torque of a motion is that of all units that turn the coordinate its way, fully active and still: active share of
// the force times moment arm. docs/methods/retargeting.md.

/// What the torques of one body depend on, measured once: path lengths and moment arms over every motion. They do not
/// change with the ratios.
class TorqueGeometry {
 public:
  static constexpr int kSamples = 25;  ///< evenly over theta

  /// `postures`: motionPostures() of the reference; `units_of`: by motion, the units that span its coordinate.
  TorqueGeometry(const Model& model, const PoseTable& postures, const std::vector<std::vector<int>>& units_of,
                 const std::vector<JointMotion>& motions);
  /// The same, of which `unchanged` units are taken over from `previous`.
  TorqueGeometry(const Model& model, const PoseTable& postures, const std::vector<std::vector<int>>& units_of,
                 const std::vector<JointMotion>& motions, const TorqueGeometry& previous,
                 const std::vector<bool>& unchanged);

  struct UnitInMotion {
    int unit = -1;
    std::vector<double> length_m, arm_m;  ///< by sample; arm 0 where the unit does not turn the motion's way
  };
  const std::vector<UnitInMotion>& unitsOf(std::size_t motion) const { return units_[motion]; }
  std::size_t motionCount() const { return units_.size(); }

 private:
  std::vector<std::vector<UnitInMotion>> units_;
};

/// Three postures a sample of every motion: a little before, at, a little behind.
PoseTable motionPostures(const Skeleton& skeleton, const std::vector<JointMotion>& motions);

/// Torque of one motion by sample [N m], and where it is greatest.
std::vector<double> motionTorque_Nm(const Musculature& musculature, const TorqueGeometry& geometry,
                                    std::size_t motion);
/// theta in [0, 1] of the greatest torque, on the parabola through the samples around it; NaN if nothing turns.
double peakTheta(const std::vector<double>& torque_Nm);

struct PeakTorqueAngle {
  std::string motion;
  double reference_deg = 0, before_deg = 0, after_deg = 0;  ///< before: fibre : tendon ratios of the reference
};

struct PeakTorqueOptions {
  double largest_change = 0.3;  ///< of a ratio
  double ratio_price = 1e-4;    ///< of a squared relative change, against squared shares of the greatest torque
  int most_iterations = 30;
};

struct PeakTorqueResult {
  Outcome outcome = Outcome::NotRun;
  std::vector<PeakTorqueAngle> angles;  ///< by motion
  std::vector<double> ratio;            ///< by unit: fibre : tendon relative to before
  int iterations = 0;
};

/// Changes fibre and tendon lengths of `musculature`. `wanted_theta`: peakTheta() of the reference by motion.
PeakTorqueResult optimizePeakTorque(const TorqueGeometry& geometry, const std::vector<JointMotion>& motions,
                                    const std::vector<double>& wanted_theta, Musculature& musculature,
                                    const PeakTorqueOptions& options = {}, const Job& job = {});

}  // namespace sinew
