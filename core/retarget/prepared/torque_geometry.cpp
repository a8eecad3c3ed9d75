#include "core/retarget/prepared/torque_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.h"
#include "core/kernel/batch.h"
#include "core/muscle/hill.h"
#include "core/retarget/prepared/length_curve.h"

namespace sinew {
namespace {

constexpr int kSamples = TorqueGeometry::kSamples;
constexpr double kStep_rad = 1e-4;  // of the differences that moment arms are taken from

double thetaOf(int sample) {
  return double(sample) / (kSamples - 1);
}

double span_rad(const JointMotion& motion) {
  return std::abs(motion.end_deg - motion.start_deg) * kRadPerDeg;
}

}  // namespace

PoseTable motionPostures(const Skeleton& skeleton, const std::vector<JointMotion>& motions) {
  PoseTable table{motions.size() * kSamples * 3, static_cast<std::size_t>(skeleton.coordinateCount())};
  std::size_t pose = 0;
  for (const JointMotion& motion : motions)
    for (int s = 0; s < kSamples; ++s)
      for (const int side : {-1, 0, 1})
        table.set(pose++, motionPosture(skeleton, motion, thetaOf(s) + side * kStep_rad / span_rad(motion)));
  return table;
}

TorqueGeometry::TorqueGeometry(const Model& model, const PoseTable& postures,
                               const std::vector<std::vector<int>>& units_of, const std::vector<JointMotion>& motions)
    : TorqueGeometry{model, postures, units_of, motions, *this, {}} {}

TorqueGeometry::TorqueGeometry(const Model& model, const PoseTable& postures,
                               const std::vector<std::vector<int>>& units_of, const std::vector<JointMotion>& motions,
                               const TorqueGeometry& previous, const std::vector<bool>& unchanged) {
  const auto isUnchanged = [&](int unit) { return !unchanged.empty() && unchanged[static_cast<std::size_t>(unit)]; };
  Musculature measured;
  std::vector<std::size_t> column(model.musculature.units.size(), 0);
  for (std::size_t u = 0; u < column.size(); ++u)
    if (!isUnchanged(static_cast<int>(u))) {
      column[u] = measured.units.size();
      measured.units.push_back(model.musculature.units[u]);
    }
  PoseTable lengths_m;
  if (!measured.units.empty()) batchLengths(CompiledModel{model.skeleton, measured}, postures, lengths_m);
  for (std::size_t m = 0; m < motions.size(); ++m) {
    auto& units = units_.emplace_back();
    for (const int unit : units_of[m]) {
      if (isUnchanged(unit)) {
        const auto known = std::ranges::find(previous.units_[m], unit, &UnitInMotion::unit);
        if (known != previous.units_[m].end()) units.push_back(*known);
        continue;
      }
      UnitInMotion swept{unit, {}, {}};
      for (int s = 0; s < kSamples; ++s) {
        const std::size_t pose = (m * kSamples + static_cast<std::size_t>(s)) * 3;
        const auto at = [&](std::size_t side) {
          return lengths_m(pose + side, column[static_cast<std::size_t>(unit)]);
        };
        swept.length_m.push_back(at(1));
        // A unit that shortens along the motion turns its way.
        swept.arm_m.push_back(std::max(0.0, (at(0) - at(2)) / (2 * kStep_rad)));
      }
      if (std::ranges::any_of(swept.arm_m, [](double r) { return r > 0; })) units.push_back(std::move(swept));
    }
  }
}

std::vector<std::vector<UnitPart>> partsByUnit(const TorqueGeometry& geometry, std::size_t unit_count) {
  std::vector<std::vector<UnitPart>> parts(unit_count);
  for (std::size_t m = 0; m < geometry.motionCount(); ++m)
    for (std::size_t k = 0; k < geometry.unitsOf(m).size(); ++k)
      parts[static_cast<std::size_t>(geometry.unitsOf(m)[k].unit)].push_back({m, k});
  return parts;
}

std::vector<double> unitTorque_Nm(const MusculotendonUnit& unit, const TorqueGeometry::UnitInMotion& swept) {
  std::vector<double> torque_Nm(kSamples, 0.0);
  for (std::size_t s = 0; s < torque_Nm.size(); ++s)
    if (swept.arm_m[s] > 0) torque_Nm[s] = swept.arm_m[s] * equilibrium(unit, swept.length_m[s], 1).active_force_N;
  return torque_Nm;
}

std::vector<double> motionTorque_Nm(const Musculature& musculature, const TorqueGeometry& geometry,
                                    std::size_t motion) {
  std::vector<double> torque_Nm(kSamples, 0.0);
  for (const auto& swept : geometry.unitsOf(motion)) {
    const auto of_unit = unitTorque_Nm(musculature.units[static_cast<std::size_t>(swept.unit)], swept);
    for (std::size_t s = 0; s < torque_Nm.size(); ++s) torque_Nm[s] += of_unit[s];
  }
  return torque_Nm;
}

double peakTheta(std::span<const double> torque_Nm) {
  if (!(*std::ranges::max_element(torque_Nm) > 0)) return std::numeric_limits<double>::quiet_NaN();
  return curveFeatures(torque_Nm).longest.theta;
}

}  // namespace sinew
