#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/muscle/musculature.h"
#include "core/rom/poses/longest_paths.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// Fibre and tendon lengths from what the body can do (Ryu et al., Length estimation): the longest length of a unit,
// 1.6 l0 + 1.03 l_slack, is the longest path over all postures; the published fibre : tendon ratio is kept. A path
// that is long at rest too would then pull at rest; such a unit is lengthened, ratio kept, until its passive force in
// every resting posture is below a small share of F_max. A fibre that would be too short to work, standing or at the
// short end of the normal range, takes length from its tendon. See docs/methods/range_of_motion.md.

struct LengthEstimate {
  std::string unit;
  double optimal_fiber_length_m = 0;
  double tendon_slack_length_m = 0;
  double longest_path_m = 0, shortest_path_m = 0;  ///< over the postures
  double scale = 1;                                ///< of the given fibre length
  double ratio = 1;                                ///< of the given ratio tendon : fibre
  bool relaxed = false;                            ///< lengthened for a resting posture
  double resting_normalized_fiber = 0;             ///< in the first resting posture
  /// Passive, over the postures; NaN until the lengths are final (fitPreset()).
  double shortest_normalized_fiber = std::numeric_limits<double>::quiet_NaN(),
         longest_normalized_fiber = std::numeric_limits<double>::quiet_NaN();
};

/// Tendon becomes fibre until a unit has its shortest fibre, in the first resting posture and on its working path.
/// The working path counts only where the least fibre can be had within the two bounds.
struct LengthEstimationOptions {
  double resting_force_share = 0.008;        ///< of F_max; the fibre is then at 1.09 l0
  double shortest_fiber = 0.5;               ///< in optimal lengths
  double least_working_fiber = 0.4;          ///< in optimal lengths
  double smallest_ratio = 0.7;               ///< of the given tendon : fibre; the 30 % of Ryu et al.
  double longest_fiber_of_published = 1.32;  ///< of the given fibre: within two standard deviations between people
};

/// By unit, the path on which its fibre should still work [m], and the factor by which clinical tests will yet
/// lengthen fibre and tendon (none if empty). Not asked for if empty.
struct WorkingPaths {
  Eigen::VectorXd shortest_m, lengthened;
};

/// One estimate a unit, in the order of `musculature`; `limits` are its paths over a pose set, `resting` the key
/// postures (at least one).
std::vector<LengthEstimate> estimateLengths(const Skeleton& skeleton, const Musculature& musculature,
                                            const PathLimits& limits, std::span<const Posture> resting,
                                            const LengthEstimationOptions& options = {},
                                            const WorkingPaths& working = {});

/// `musculature` with these lengths.
Musculature withLengths(Musculature musculature, const std::vector<LengthEstimate>& estimates);

/// Smallest factor >= 1 on fibre and tendon with which the unit's passive force at this path length is at most
/// `share` of F_max.
double relaxingFactor(const MusculotendonUnit& unit, double path_m, double share);

/// The estimates of the right side, as muscles/reference_lengths*.csv hold them; lengths rounded up to 0.1 um, so
/// that no posture of the set becomes invalid.
std::string lengthsCsv(const std::vector<LengthEstimate>& estimates, const std::string& made_from);

}  // namespace sinew
