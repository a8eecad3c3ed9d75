#include <algorithm>
#include <cmath>
#include <memory>

#include "core/parallel.h"
#include "core/retarget/motion_torques_internal.h"

namespace sinew {

MotionTorques::MotionTorques(const TorqueGeometry& geometry, const Musculature& musculature)
    : geometry_{geometry}, parts_{partsByUnit(geometry, musculature.units.size())} {
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
  state.torque_Nm.assign(geometry_.motionCount(), Samples::Zero());
  for (std::size_t m = 0; m < geometry_.motionCount(); ++m) state.shares.emplace_back(geometry_.unitsOf(m).size());
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
    Samples& torque = state.torque_Nm[changed[i].front().motion];
    auto& shares = state.shares[changed[i].front().motion];
    for (const UnitPart& part : changed[i]) sweep(part, shares[part.place]);
    torque.setZero();  // summed anew: the same whatever changed before
    for (const Share& share : shares) torque += share.torque_Nm;
  };
  if (changed.size() > kFew)
    forEachInParallel(changed.size(), {}, "peak torque", update);
  else
    for (std::size_t i = 0; i < changed.size(); ++i) update(i);
}

void MotionTorques::sweep(UnitPart part, Share& share) const {
  const TorqueGeometry::UnitInMotion& swept = geometry_.unitsOf(part.motion)[part.place];
  const RatioForce& force = forces_[static_cast<std::size_t>(swept.unit)];
  double before = 0;  // at the sample before: where the first search of all starts
  for (int s = 0; s < TorqueGeometry::kSamples; ++s) {
    const auto i = static_cast<std::size_t>(s);
    if (!(swept.arm_m[i] > 0)) continue;
    double& fiber = share.fiber[s];
    if (fiber == 0) fiber = before;
    const CurveValue at = force.at(swept.length_m[i], fiber);
    before = fiber;
    share.torque_Nm[s] = swept.arm_m[i] * at.value;
    share.slope_Nm[s] = swept.arm_m[i] * at.slope;
  }
}

double peakTheta(const MotionTorques::Samples& torque_Nm) {
  return peakTheta(std::span<const double>{torque_Nm.data(), static_cast<std::size_t>(torque_Nm.size())});
}

}  // namespace sinew
