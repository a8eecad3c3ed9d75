#include <algorithm>
#include <cmath>
#include <memory>

#include "core/parallel.h"
#include "core/retarget/peaks/motion_torques_internal.h"

namespace sinew {

MotionTorques::MotionTorques(const TorqueGeometry& geometry, const Musculature& musculature)
    : geometry_{geometry}, parts_{partsByUnit(geometry, musculature.units.size())} {
  first_share_.push_back(0);
  for (std::size_t m = 0; m < geometry.motionCount(); ++m)
    first_share_.push_back(first_share_.back() + geometry.unitsOf(m).size());
  std::vector<std::shared_ptr<const FiberTable>> tables;
  for (const MusculotendonUnit& unit : musculature.units) {
    const double cosine = std::cos(unit.pennation_angle_at_optimal_rad);
    auto known = std::ranges::find_if(tables, [&](const auto& t) { return t->isOf(unit.curves, cosine); });
    if (known == tables.end()) known = tables.insert(known, std::make_shared<const FiberTable>(unit.curves, cosine));
    forces_.emplace_back(unit, *known);
  }
}

MotionTorques::State MotionTorques::original() {
  State state;
  state.torque_Nm.setZero(TorqueGeometry::kSamples, static_cast<Eigen::Index>(geometry_.motionCount()));
  state.shares.resize(first_share_.back());
  move(state, Eigen::VectorXd::Ones(static_cast<Eigen::Index>(forces_.size())));
  return state;
}

void MotionTorques::move(State& state, const Eigen::VectorXd& ratio) {
  constexpr std::size_t kFew = 16;  // motions for which more threads would not pay
  std::vector<std::vector<UnitPart>> changed(geometry_.motionCount());
  for (std::size_t u = 0; u < forces_.size(); ++u) {
    const auto i = static_cast<Eigen::Index>(u);
    if (state.ratio.size() > 0 && ratio[i] == state.ratio[i]) continue;
    forces_[u].setFactor(ratio[i]);
    for (const UnitPart& part : parts_[u]) changed[part.motion].push_back(part);
  }
  state.ratio = ratio;
  std::erase_if(changed, [](const auto& parts) { return parts.empty(); });
  const auto update = [&](std::size_t i) {
    const std::size_t m = changed[i].front().motion;
    for (const UnitPart& part : changed[i]) {
      const int unit = geometry_.unitsOf(m)[part.place].unit;
      sweep(part, ratio[unit], state.shares[first_share_[m] + part.place]);
    }
    auto torque = state.torque_Nm.col(static_cast<Eigen::Index>(m));
    torque.setZero();  // summed anew: the same whatever changed before
    for (std::size_t k = first_share_[m]; k < first_share_[m + 1]; ++k) torque += state.shares[k].torque_Nm;
  };
  if (changed.size() > kFew)
    forEachInParallel(changed.size(), {}, "peak torque", update);
  else
    for (std::size_t i = 0; i < changed.size(); ++i) update(i);
}

void MotionTorques::differential(const State& state, const Eigen::VectorXd& change, Table& torque_Nm) const {
  torque_Nm.setZero(TorqueGeometry::kSamples, static_cast<Eigen::Index>(geometry_.motionCount()));
  for (std::size_t m = 0; m < geometry_.motionCount(); ++m)
    for (std::size_t k = 0; k < geometry_.unitsOf(m).size(); ++k)
      if (const double by = change[geometry_.unitsOf(m)[k].unit]; by != 0)
        torque_Nm.col(static_cast<Eigen::Index>(m)) += by * state.shares[first_share_[m] + k].slope_Nm;
}

Eigen::VectorXd MotionTorques::bends(const State& from, const State& to) const {
  const Eigen::RowVectorXd greatest_Nm = from.torque_Nm.colwise().maxCoeff();
  Eigen::VectorXd bends = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parts_.size()));
  for (std::size_t u = 0; u < parts_.size(); ++u) {
    const auto i = static_cast<Eigen::Index>(u);
    const double change = to.ratio[i] - from.ratio[i];
    if (change == 0) continue;
    for (const UnitPart& part : parts_[u]) {
      const Share &now = from.shares[first_share_[part.motion] + part.place],
                  &then = to.shares[first_share_[part.motion] + part.place];
      const double off_Nm = (then.torque_Nm - now.torque_Nm - change * now.slope_Nm).cwiseAbs().maxCoeff();
      const double whole_Nm = greatest_Nm[static_cast<Eigen::Index>(part.motion)];
      if (whole_Nm > 0) bends[i] = std::max(bends[i], off_Nm / whole_Nm);
    }
  }
  return bends;
}

void MotionTorques::sweep(UnitPart part, double ratio, Share& share) const {
  const TorqueGeometry::UnitInMotion& swept = geometry_.unitsOf(part.motion)[part.place];
  const RatioForce& force = forces_[static_cast<std::size_t>(swept.unit)];
  const double change = ratio - share.ratio;
  share.ratio = ratio;
  double before = 0;  // at the sample before: where the first search of all starts
  for (int s = 0; s < TorqueGeometry::kSamples; ++s) {
    const auto i = static_cast<std::size_t>(s);
    if (!(swept.arm_m[i] > 0)) continue;
    CurveValue fiber{share.fiber[s] == 0 ? before : share.fiber[s] + change * share.fiber_slope[s]};
    const CurveValue force_N = force.at(swept.length_m[i], fiber);
    share.fiber[s] = before = fiber.value;
    share.fiber_slope[s] = fiber.slope;
    share.torque_Nm[s] = swept.arm_m[i] * force_N.value;
    share.slope_Nm[s] = swept.arm_m[i] * force_N.slope;
  }
}

double peakTheta(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm) {
  return peakTheta(std::span<const double>{torque_Nm.data(), static_cast<std::size_t>(torque_Nm.size())});
}

}  // namespace sinew
