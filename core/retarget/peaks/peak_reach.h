#pragma once
#include <span>

#include "core/muscle/musculature.h"
#include "core/retarget/prepared/torque_geometry.h"

namespace sinew {

// Whether step 3 could bring the angle of peak torque of one motion, alone, to where it is wanted. Most of what stays
// missed cannot be had: the moment arms of the new body have another shape. docs/methods/retargeting.md.

enum class PeakReach {
  Within,    ///< ratios are known that do
  Out,       ///< proven: no ratios do
  Undecided  ///< neither was found
};

struct PeakReachOptions {
  double tolerance_deg = 3;
  double largest_change = 0.3;  ///< of a ratio
  int ratios = 121;             ///< that are tried of every unit, evenly within the bounds
  int most_rounds = 2000;
};

/// One motion, at place `index` of the geometry.
struct PeakWish {
  std::size_t index;
  const JointMotion& motion;
  double wanted_theta;
};

/// Decides whether all wishes can be had at once. `musculature`: ratios of before step 3.
///
/// That the peak lies in a given interval are linear conditions c on the torques (of one of a few alternatives), and
/// the torques are sums over the units, each a function of its own ratio alone. So for any weights w >= 0 of the
/// conditions the weighted sum of all is greatest where every unit is at its own best ratio; if even then it is
/// negative, no ratios fulfil all conditions. Weights are searched for by multiplicative updates.
PeakReach peakReach(const TorqueGeometry& geometry, std::span<const PeakWish> wishes, const Musculature& musculature,
                    const PeakReachOptions& options = {});
inline PeakReach peakReach(const TorqueGeometry& geometry, std::size_t index, const JointMotion& motion,
                           double wanted_theta, const Musculature& musculature,
                           const PeakReachOptions& options = {}) {
  const PeakWish wish{index, motion, wanted_theta};
  return peakReach(geometry, {&wish, 1}, musculature, options);
}

}  // namespace sinew
