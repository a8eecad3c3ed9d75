#include <algorithm>
#include <cmath>
#include <utility>

#include "core/retarget/peaks/pursued_peaks_internal.h"

namespace sinew {

PursuedPeaks::PursuedPeaks(const std::vector<JointMotion>& motions, const std::vector<double>& wanted_theta,
                           const MotionTorques::Table& first_Nm) {
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const MotionTorques::Samples torque_Nm = first_Nm.col(static_cast<Eigen::Index>(m));
    if (std::isnan(wanted_theta[m]) || !(torque_Nm.maxCoeff() > 0)) continue;
    PursuedPeak& p = peaks_.emplace_back(PursuedPeak{{m, motions[m], wanted_theta[m], torque_Nm}});
    p.was_within = p.isWithin(first_Nm);
  }
}

PeakRank PursuedPeaks::rank(const MotionTorques::Table& torque_Nm) const {
  PeakRank rank;
  int lost = 0;
  for (const PursuedPeak& p : peaks_) {
    const bool is_within = p.isWithin(torque_Nm);
    rank.within += is_within;
    lost += p.was_within && !is_within;
    rank.energy += std::pow(p.target.off(p.of(torque_Nm)), 2);
  }
  if (lost > 0) rank.within = -lost;
  return rank;
}

bool PursuedPeaks::areRight(const MotionTorques::Table& torque_Nm) const {
  constexpr double kRight_deg = 0.01;
  return std::ranges::all_of(peaks_,
                             [&](const PursuedPeak& p) { return p.target.off_deg(p.of(torque_Nm)) <= kRight_deg; });
}

bool PursuedPeaks::holdFaster(const MotionTorques::Table& torque_Nm, const MotionTorques::Table& best_Nm) {
  constexpr double kMore = 10;
  bool has_lost = false;
  for (PursuedPeak& p : peaks_) {
    const bool is_held = p.is_wanted || p.isWithin(best_Nm);
    if (!is_held || p.isWithin(torque_Nm)) continue;
    p.weight *= kMore;
    has_lost = true;
  }
  return has_lost;
}

std::vector<WeightedResiduals> PursuedPeaks::violations(const MotionTorques::Table& torque_Nm) const {
  std::vector<WeightedResiduals> list;
  for (const PursuedPeak& p : peaks_) {
    if (p.weight == 0) continue;
    TorqueResiduals left = p.target.violations(p.of(torque_Nm));
    if (!left.empty()) list.push_back({p.target.motion(), p.weight, std::move(left)});
  }
  return list;
}

std::vector<WeightedResiduals> PursuedPeaks::deviations(const MotionTorques::Table& torque_Nm,
                                                        const MotionTorques::Table& best_Nm) const {
  std::vector<WeightedResiduals> list;
  for (const PursuedPeak& p : peaks_) {
    list.push_back({p.target.motion(), 1, p.target.deviation(p.of(torque_Nm))});
    if (!p.isWithin(best_Nm)) continue;
    TorqueResiduals left = p.target.violations(p.of(torque_Nm));
    if (!left.empty()) list.push_back({p.target.motion(), p.weight, std::move(left)});
  }
  return list;
}

}  // namespace sinew
