#pragma once
#include <optional>
#include <vector>

#include "core/retarget/peaks/peak_reach.h"
#include "core/retarget/peaks/peak_torque.h"

namespace sinew {

class RetargetReference;
struct Retargeted;

/// A motion whose angle of peak torque is not within the target.
struct MissedPeak {
  PeakReach alone = PeakReach::Undecided;  ///< whether any ratios would bring it there, were it alone
  /// If so: a motion that is there and, proven, cannot be together with this one.
  std::optional<std::size_t> instead_of;
};
/// By motion; nullopt where it is there, or the reference has none.
std::vector<std::optional<MissedPeak>> missedPeaks(const RetargetReference& reference, const Retargeted& body);

/// How many motions of bodies come within the target, and of how many it is proven that they cannot.
struct PeakCount {
  int motions = 0, before = 0, after = 0;
  int left = 0;                         ///< within before, not after
  int out_of_reach = 0, undecided = 0;  ///< each alone
  int instead = 0;                      ///< not together with one that is within
  double worst_before_deg = 0, worst_after_deg = 0;
  PeakCount& operator+=(const PeakCount& other);
};
PeakCount peakCount(const std::vector<PeakTorqueAngle>& angles, const std::vector<std::optional<MissedPeak>>& missed);

/// Of many bodies together.
struct PeakCounts {
  Outcome outcome = Outcome::NotRun;
  PeakCount count;
};
PeakCounts peakCounts(const RetargetReference& reference, const std::vector<ShapeParameters>& shapes,
                      const Job& job = {});

}  // namespace sinew
