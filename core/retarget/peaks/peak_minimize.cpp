#include <algorithm>
#include <utility>

#include "core/retarget/peaks/peak_minimize_internal.h"

namespace sinew {
namespace {

struct Point {
  Eigen::VectorXd ratio;
  MotionTorques::Table torque_Nm;
  std::vector<WeightedResiduals> left;
  double energy = 0;

  void evaluate(const PeakObjective& objective) {
    left = objective.residuals(torque_Nm);
    energy = energyOf(left, ratio, objective.ratio_price);
  }
};

/// Moves `best` towards `target` as far as that is better.
bool descend(Point& best, const Eigen::VectorXd& target, const MotionTorques& torques,
             const MotionTorques::State& state, const PeakObjective& objective) {
  constexpr double kLeastShare = 0.01;
  const Eigen::VectorXd change = target - best.ratio;
  MotionTorques::Table change_Nm;
  torques.differential(state, change, change_Nm);
  Point next;
  for (double share = 1; share > kLeastShare; share *= 0.5) {
    next.ratio = best.ratio + share * change;
    next.torque_Nm = best.torque_Nm + share * change_Nm;
    next.evaluate(objective);
    if (!(next.energy < best.energy)) continue;
    std::swap(best, next);
    return true;
  }
  return false;
}

/// The minimum within `reach` of `state`, were torques straight. Gauss-Newton: what is violated changes on the way.
Point predictedMinimum(const MotionTorques& torques, const MotionTorques::State& state,
                       const PeakObjective& objective, const Eigen::VectorXd& reach) {
  constexpr int kMost = 15;
  constexpr double kSettled = 1e-3;
  const Eigen::VectorXd low = (state.ratio - reach).cwiseMax(1 - objective.largest_change);
  const Eigen::VectorXd high = (state.ratio + reach).cwiseMin(1 + objective.largest_change);
  Point best{state.ratio, state.torque_Nm, {}, 0};
  best.evaluate(objective);
  for (int i = 0; i < kMost; ++i) {
    const double before = best.energy;
    const PeakRows rows{best.left, torques, state};
    if (!descend(best, rows.target(best.ratio, low, high, objective.ratio_price), torques, state, objective)) break;
    if (!(best.energy < before * (1 - kSettled))) break;
  }
  return best;
}

/// Units whose torques bend most between two states may go less far than they went.
void shrink(Eigen::VectorXd& reach, const MotionTorques& torques, const MotionTorques::State& from,
            const MotionTorques::State& to) {
  constexpr double kShare = 0.3, kBent = 0.1;  // of the way; of the strongest bend
  const Eigen::VectorXd bends = torques.bends(from, to);
  const double bent = kBent * bends.maxCoeff();
  for (Eigen::Index u = 0; u < reach.size(); ++u)
    if (bends[u] > 0 && bends[u] >= bent)
      reach[u] = std::min(reach[u], kShare * std::abs(to.ratio[u] - from.ratio[u]));
}

}  // namespace

void minimize(MotionTorques& torques, MotionTorques::State& state, const PeakObjective& objective,
              const std::function<bool()>& goesOn) {
  constexpr double kSettled = 1e-2;           // of the energy
  constexpr double kPoor = 0.3, kGood = 0.7;  // what came of what was hoped for
  constexpr int kMostFailures = 5;            // one after the other
  Eigen::VectorXd reach = Eigen::VectorXd::Constant(state.ratio.size(), 2 * objective.largest_change);
  Point now{state.ratio, state.torque_Nm, {}, 0};
  now.evaluate(objective);
  MotionTorques::State next_state;
  for (int failures = 0; failures < kMostFailures && !now.left.empty();) {
    const Point hoped = predictedMinimum(torques, state, objective, reach);
    if (!(hoped.energy < now.energy * (1 - kSettled)) || !goesOn()) break;
    next_state = state;
    torques.move(next_state, hoped.ratio);
    Point next{next_state.ratio, next_state.torque_Nm, {}, 0};
    const bool allowed = !objective.allows || objective.allows(next.torque_Nm);
    if (!allowed) now.evaluate(objective);
    next.evaluate(objective);
    const double kept = allowed ? (now.energy - next.energy) / (now.energy - hoped.energy) : 0;
    if (kept < kPoor) shrink(reach, torques, state, next_state);
    if (!(kept > 0)) {
      ++failures;
      continue;
    }
    if (kept > kGood) reach = reach.cwiseMax(2 * (next.ratio - now.ratio).cwiseAbs());
    failures = 0;
    std::swap(state, next_state);
    std::swap(now, next);
  }
}

}  // namespace sinew
