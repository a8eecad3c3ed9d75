#pragma once
#include <vector>

#include "core/retarget/peaks/motion_torques_internal.h"
#include "core/retarget/peaks/peak_target_internal.h"

namespace sinew {

/// Residuals of one motion.
struct WeightedResiduals {
  std::size_t motion = 0;
  double weight = 1;
  TorqueResiduals residuals;
};

/// The weighted sum of squares, and what changed ratios cost.
double energyOf(const std::vector<WeightedResiduals>& list, const Eigen::VectorXd& ratio, double ratio_price);

/// Residuals as straight functions of the ratios: a sparse row each, of the units that turn the motion.
class PeakRows {
 public:
  /// Slopes are those in `state`.
  PeakRows(const std::vector<WeightedResiduals>& list, const MotionTorques& torques,
           const MotionTorques::State& state);

  /// Where the weighted sum of squares and the price of changed ratios is least within bounds. `from`: where the
  /// values are those of the residuals.
  Eigen::VectorXd target(const Eigen::VectorXd& from, const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                         double ratio_price) const;

 private:
  struct Row {
    double value, weight;
    std::size_t first, end;  ///< of entries_
  };
  struct Entry {
    Eigen::Index unit;
    double slope;
  };
  struct Dual;

  double dot(const Row& row, const Eigen::VectorXd& by_unit) const;
  Eigen::VectorXd values(const Eigen::VectorXd& change) const;
  Eigen::VectorXd forces(const Eigen::VectorXd& right, const std::vector<bool>& free, double ratio_price) const;

  std::vector<Row> rows_;
  std::vector<Entry> entries_;
};

}  // namespace sinew
