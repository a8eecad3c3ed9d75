#pragma once
#include <string>
#include <vector>

#include "core/job.h"
#include "core/retarget/prepared/torque_geometry.h"

namespace sinew {

// Step 3 of retargeting (Ryu et al., Angle of Peak Torque): fibre : tendon ratios within 30 % of the reference's, the
// longest length kept, so that every joint motion has its greatest torque at the same angle as in the reference. The
// torque of a motion is that of all units that turn the coordinate its way, fully active and still: active share of
// the force times moment arm. docs/methods/retargeting.md.

/// How far the angle of peak torque may be off.
inline constexpr double kPeakTorqueTarget_deg = 3;

struct PeakTorqueAngle {
  std::string motion;
  double reference_deg = 0, before_deg = 0, after_deg = 0;  ///< before: fibre : tendon ratios of the reference
};

struct PeakTorqueOptions {
  double largest_change = 0.3;  ///< of a ratio
  double ratio_price = 1e-4;    ///< of a squared relative change, against squared shares of the greatest torque
  int most_iterations = 200;
  /// By unit: its counterpart on the other side (-1: none), in a body whose sides are alike; both then keep the same
  /// ratio if that costs no motion. Empty: the sides differ.
  std::vector<int> mirror_of;
  std::vector<int> mirror_motion_of;  ///< by motion, likewise: both are brought within the target at once
};

struct PeakTorqueResult {
  Outcome outcome = Outcome::NotRun;
  std::vector<PeakTorqueAngle> angles;  ///< by motion
  std::vector<double> ratio;            ///< by unit: fibre : tendon relative to before
  int iterations = 0;
};

/// Changes fibre and tendon lengths of `musculature`. `wanted_theta`: peakTheta() of the reference by motion. As many
/// motions as can be found a way for come within kPeakTorqueTarget_deg; none that was within leaves.
PeakTorqueResult optimizePeakTorque(const TorqueGeometry& geometry, const std::vector<JointMotion>& motions,
                                    const std::vector<double>& wanted_theta, Musculature& musculature,
                                    const PeakTorqueOptions& options = {}, const Job& job = {});

/// The paper's way: gradient descent on the sum of (theta - wanted)^2, the gradient by finite differences, with a
/// line search, within the same bounds. Torques are summed from measured paths and arms, and of a difference only the
/// unit that it is of is computed anew: what the text allows at its fastest.
PeakTorqueResult descendPeakTorque(const TorqueGeometry& geometry, const std::vector<JointMotion>& motions,
                                   const std::vector<double>& wanted_theta, Musculature& musculature,
                                   const PeakTorqueOptions& options = {}, const Job& job = {});

}  // namespace sinew
