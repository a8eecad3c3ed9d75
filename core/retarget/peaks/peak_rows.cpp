#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/retarget/peaks/peak_rows_internal.h"

namespace sinew {

double energyOf(const std::vector<WeightedResiduals>& list, const Eigen::VectorXd& ratio, double ratio_price) {
  double sum = ratio_price * (ratio.array() - 1).matrix().squaredNorm();
  for (const WeightedResiduals& motion : list) sum += motion.weight * energyOf(motion.residuals);
  return sum;
}

PeakRows::PeakRows(const std::vector<WeightedResiduals>& list, const MotionTorques& torques,
                   const MotionTorques::State& state) {
  for (const auto& [motion, weight, residuals] : list)
    for (const TorqueResidual& residual : residuals) {
      Row& row = rows_.emplace_back(Row{residual.value, weight, entries_.size(), 0});
      const auto& units = torques.geometry().unitsOf(motion);
      for (std::size_t k = 0; k < units.size(); ++k) {
        const auto& by_ratio_Nm = state.shares[torques.sharesOf(motion) + k].slope_Nm;
        double slope = 0;
        for (std::size_t i = 0; i < 3; ++i) slope += residual.slope_1_Nm[i] * by_ratio_Nm[residual.sample[i]];
        if (slope != 0) entries_.push_back({units[k].unit, slope});
      }
      row.end = entries_.size();
    }
}

double PeakRows::dot(const Row& row, const Eigen::VectorXd& by_unit) const {
  double sum = 0;
  for (std::size_t e = row.first; e < row.end; ++e) sum += entries_[e].slope * by_unit[entries_[e].unit];
  return sum;
}

/// Values when ratios have changed by so much.
Eigen::VectorXd PeakRows::values(const Eigen::VectorXd& change) const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(rows_.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    values[i] = row.value + dot(row, change);
  }
  return values;
}

/// Solves (W^-1 + S D^-1 S') f = right, S the rows, D = 2 price of the free units, W = 2 weight.
Eigen::VectorXd PeakRows::forces(const Eigen::VectorXd& right, const std::vector<bool>& free,
                                 double ratio_price) const {
  const auto count = static_cast<Eigen::Index>(rows_.size());
  Eigen::MatrixXd system(count, count);
  Eigen::VectorXd spread = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free.size()));
  for (Eigen::Index i = 0; i < count; ++i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    for (std::size_t e = row.first; e < row.end; ++e)
      if (free[static_cast<std::size_t>(entries_[e].unit)])
        spread[entries_[e].unit] = entries_[e].slope / (2 * ratio_price);
    for (Eigen::Index j = i; j < count; ++j) system(j, i) = dot(rows_[static_cast<std::size_t>(j)], spread);
    system(i, i) += 0.5 / row.weight;
    for (std::size_t e = row.first; e < row.end; ++e) spread[entries_[e].unit] = 0;
  }
  return system.selfadjointView<Eigen::Lower>().llt().solve(right);
}

/// The dual problem: forces f of the rows pull the ratios from 1 to 1 - S' f / 2 price, as far as the bounds let
/// them; at its maximum is f = 2 weight value.
struct PeakRows::Dual {
  Eigen::VectorXd force, pulled, ratio, slope;
  double value = 0;

  Dual(const PeakRows& rows, Eigen::VectorXd forces, const Eigen::VectorXd& from, const Eigen::VectorXd& low,
       const Eigen::VectorXd& high, double ratio_price)
      : force{std::move(forces)}, pulled{Eigen::VectorXd::Ones(from.size())} {
    const double share = 0.5 / ratio_price;
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      const Row& row = rows.rows_[static_cast<std::size_t>(i)];
      for (std::size_t e = row.first; e < row.end; ++e)
        pulled[rows.entries_[e].unit] -= share * rows.entries_[e].slope * force[i];
    }
    ratio = pulled.cwiseMax(low).cwiseMin(high);
    slope = rows.values(ratio - from);
    value = ratio_price * (ratio.array() - 1).matrix().squaredNorm() + force.dot(slope);
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      const double yielding = force[i] / (2 * rows.rows_[static_cast<std::size_t>(i)].weight);
      value -= 0.5 * force[i] * yielding;
      slope[i] -= yielding;
    }
  }
};

Eigen::VectorXd PeakRows::target(const Eigen::VectorXd& from, const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                                 double ratio_price) const {
  // Newton over the rows, which are fewer than the units. The dual is concave, of pieces that are quadratic: where
  // units get to their bounds on the way, a step is too long.
  constexpr int kMost = 20, kMostTrials = 20;
  constexpr double kSettled = 1e-5, kFlat = 0.1;
  const auto dual = [&](Eigen::VectorXd force) {
    return Dual{*this, std::move(force), from, low, high, ratio_price};
  };
  std::vector<bool> free;
  Eigen::VectorXd start = Eigen::VectorXd::Ones(from.size());  // first with those held that are at a bound
  for (Eigen::Index u = 0; u < from.size(); ++u) {
    free.push_back(from[u] > low[u] && from[u] < high[u]);
    if (!free.back()) start[u] = from[u];
  }
  Dual now = dual(forces(values(start - from), free, ratio_price));
  for (int k = 0; k < kMost; ++k) {
    for (Eigen::Index u = 0; u < from.size(); ++u) free[static_cast<std::size_t>(u)] = now.ratio[u] == now.pulled[u];
    const Eigen::VectorXd step = forces(now.slope, free, ratio_price);
    const double rise = step.dot(now.slope);
    double near = 0, far = 1;  // between them is the highest point of the line
    Dual next = dual(now.force + step);
    double slope = std::max(0.0, -step.dot(next.slope));
    for (int trial = 0; trial < kMostTrials && std::abs(slope) > kFlat * rise; ++trial) {
      const double share = 0.5 * (near + far);
      next = dual(now.force + share * step);
      slope = step.dot(next.slope);
      (slope > 0 ? near : far) = share;
    }
    const bool settled = (next.ratio - now.ratio).cwiseAbs().maxCoeff() < kSettled;
    now = std::move(next);
    if (settled) break;
  }
  return now.ratio;
}

}  // namespace sinew
