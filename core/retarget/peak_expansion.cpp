#include "core/retarget/peak_expansion_internal.h"

namespace sinew {
namespace {

/// Slopes of a motion's residuals (rows) with the ratios of its units.
Eigen::MatrixXd slopesOf(const TorqueResiduals& residuals, const std::vector<MotionTorques::Share>& shares) {
  Eigen::MatrixXd slopes(static_cast<Eigen::Index>(residuals.size()), static_cast<Eigen::Index>(shares.size()));
  for (Eigen::Index k = 0; k < slopes.cols(); ++k)
    for (Eigen::Index r = 0; r < slopes.rows(); ++r) {
      const TorqueResidual& residual = residuals[static_cast<std::size_t>(r)];
      const auto& by_ratio_Nm = shares[static_cast<std::size_t>(k)].slope_Nm;
      slopes(r, k) = 0;
      for (std::size_t i = 0; i < 3; ++i) slopes(r, k) += residual.slope_1_Nm[i] * by_ratio_Nm[residual.sample[i]];
    }
  return slopes;
}

}  // namespace

double energyOf(const std::vector<WeightedResiduals>& list, const Eigen::VectorXd& ratio, double ratio_price) {
  double sum = ratio_price * (ratio.array() - 1).matrix().squaredNorm();
  for (const WeightedResiduals& motion : list) sum += motion.weight * energyOf(motion.residuals);
  return sum;
}

PeakExpansion expansionOf(const std::vector<WeightedResiduals>& list, const MotionTorques& torques,
                          const MotionTorques::State& state, double ratio_price) {
  PeakExpansion e;
  std::vector<int> place(torques.unitCount(), -1);
  for (const WeightedResiduals& motion : list)
    for (const auto& swept : torques.geometry().unitsOf(motion.motion))
      if (int& at = place[static_cast<std::size_t>(swept.unit)]; at < 0) {
        at = static_cast<int>(e.units.size());
        e.units.push_back(swept.unit);
      }
  e.gradient = 2 * ratio_price * (state.ratio(e.units).array() - 1);
  e.hessian.setZero(e.gradient.size(), e.gradient.size());
  e.hessian.diagonal().setConstant(2 * ratio_price);
  for (const auto& [motion, weight, residuals] : list) {
    const Eigen::MatrixXd slopes = slopesOf(residuals, state.shares[motion]);
    std::vector<int> columns;
    for (const auto& swept : torques.geometry().unitsOf(motion))
      columns.push_back(place[static_cast<std::size_t>(swept.unit)]);
    Eigen::VectorXd values(slopes.rows());
    for (Eigen::Index r = 0; r < values.size(); ++r) values[r] = residuals[static_cast<std::size_t>(r)].value;
    e.gradient(columns) += 2 * weight * (slopes.transpose() * values);
    e.hessian(columns, columns) += 2 * weight * (slopes.transpose() * slopes);
  }
  return e;
}

}  // namespace sinew
