#pragma once
#include <vector>

#include "core/retarget/peaks/peak_rows_internal.h"
#include "core/retarget/peaks/peak_target_internal.h"

namespace sinew {

/// How good ratios are.
struct PeakRank {
  int within = 0;     ///< motions; negative: motions that were within and have left
  double energy = 0;  ///< the paper's: sum of (theta - wanted)^2
  bool operator<(const PeakRank& other) const {
    return within != other.within ? within < other.within : energy > other.energy;
  }
};

/// A motion whose angle is to be restored, and how much it counts.
struct PursuedPeak {
  PeakTarget target;
  double weight = 1;                                 ///< 0: does not count
  bool was_within = false;                           ///< before anything was changed
  bool was_missed = false, is_out_of_reach = false;  ///< after a round; or given up
  bool is_wanted = false;                            ///< to be brought beside those that are within

  bool isWithin(const MotionTorques::Table& torque_Nm) const { return target.isWithin(of(torque_Nm)); }
  MotionTorques::Table::ConstColXpr of(const MotionTorques::Table& torque_Nm) const {
    return torque_Nm.col(static_cast<Eigen::Index>(target.motion()));
  }
};

/// All of them.
class PursuedPeaks {
 public:
  /// `first_Nm`: torques before anything is changed.
  PursuedPeaks(const std::vector<JointMotion>& motions, const std::vector<double>& wanted_theta,
               const MotionTorques::Table& first_Nm);

  std::vector<PursuedPeak>& all() { return peaks_; }
  PeakRank rank(const MotionTorques::Table& torque_Nm) const;
  /// Whether all angles are right already.
  bool areRight(const MotionTorques::Table& torque_Nm) const;
  /// Makes those count for more that are within the target at `best_Nm`, or wanted, but not within at these torques.
  /// False if there are none.
  bool holdFaster(const MotionTorques::Table& torque_Nm, const MotionTorques::Table& best_Nm);

  /// What the conditions lack.
  std::vector<WeightedResiduals> violations(const MotionTorques::Table& torque_Nm) const;
  /// What the angles are off, and what those conditions lack that hold at `best_Nm`.
  std::vector<WeightedResiduals> deviations(const MotionTorques::Table& torque_Nm,
                                            const MotionTorques::Table& best_Nm) const;

 private:
  std::vector<PursuedPeak> peaks_;
};

}  // namespace sinew
