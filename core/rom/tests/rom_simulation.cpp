#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/model/rom_preset.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/posture/validity.h"
#include "core/rom/tests/movement_internal.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kStep_deg = 2;
constexpr double kDifference_deg = 0.1;  // of the central difference that gives dl/ds: good to some um/rad

}  // namespace

Movement::Movement(const Model& model, const RomTest& test, char side)
    : model_{model}, direction_{test.to_deg > test.from_deg ? 1.0 : -1.0} {
  base_ = clinicalFromPosture(model.skeleton, test.posture(model.skeleton, side));
  end_deg_ = test.from_deg;
  for (const auto& [name, share] : test.moves) {
    Moved m{sidedCoordinate(model.skeleton, name, side), share, 0};
    const Coordinate& c = model.skeleton.coordinates[m.coordinate];
    m.stop_rad = share * direction_ > 0 ? c.stop_max_rad : c.stop_min_rad;
    moved_.push_back(m);
  }
  std::vector<Moved> moved = moved_;
  for (Moved& m : moved) {
    m.stop_rad = stopInEditedRange_rad(m, test.from_deg);
    const double stop_deg = m.stop_rad * kDegPerRad / m.share;
    if ((stop_deg - end_deg_) * direction_ > 0) end_deg_ = stop_deg;
  }
  moved_ = std::move(moved);
  if ((end_deg_ - test.to_deg) * direction_ > 0) end_deg_ = test.to_deg;
  keepThoseThatStretch(test.from_deg);
}

double Movement::stopInEditedRange_rad(const Moved& m, double from_deg) const {
  const Skeleton& skeleton = model_.skeleton;
  const Joint& joint = skeleton.joints[static_cast<std::size_t>(skeleton.coordinates[m.coordinate].joint)];
  if (joint.edited.steps.empty()) return m.stop_rad;
  const auto holds = [&](double s_deg) {
    const Posture q = postureFromClinical(skeleton, clinical(s_deg));
    const auto R_JB = rotationFromVector<double>(q.segment<3>(joint.first_coordinate));
    return ballStopMargin_rad(skeleton, joint, R_JB) >= -1e-9;
  };
  double inside = from_deg, outside = from_deg;
  while (!halted(m, outside) && holds(outside)) inside = outside, outside += direction_ * kStep_deg;
  if (holds(outside)) return m.stop_rad;
  while (std::abs(outside - inside) > 1e-3) {
    const double middle = 0.5 * (inside + outside);
    (holds(middle) ? inside : outside) = middle;
  }
  return m.share * inside / kDegPerRad;
}

Eigen::VectorXd Movement::clinical(double s_deg) const {
  Eigen::VectorXd q = base_;
  for (const Moved& m : moved_) q[m.coordinate] = at(m, s_deg);
  return q;
}

std::vector<std::pair<double, int>> Movement::moments(double s_deg) const {
  const auto here = poses(s_deg, 0), before = poses(s_deg, -kDifference_deg), after = poses(s_deg, kDifference_deg);
  std::vector<std::pair<double, int>> result;
  for (const int u : units_) {
    const MusculotendonUnit& unit = model_.musculature.units[static_cast<std::size_t>(u)];
    const double force_N = equilibrium(unit, pathLength(unit, here), 0).force_N;
    if (force_N == 0) continue;
    const double slope_m_deg = (pathLength(unit, after) - pathLength(unit, before)) / (2 * kDifference_deg);
    result.emplace_back(direction_ * slope_m_deg * kDegPerRad * force_N, u);
  }
  std::ranges::sort(result, std::greater<>{});
  return result;
}

double Movement::resistance_Nm(double s_deg) const {
  double sum = 0;
  for (const auto& [moment, unit] : moments(s_deg)) sum += moment;
  return sum;
}

int Movement::overstretched(double s_deg) const {
  constexpr double kRounding_m = 1e-9;
  const auto X_WB = poses(s_deg, 0);
  for (const int u : units_) {
    const MusculotendonUnit& unit = model_.musculature.units[static_cast<std::size_t>(u)];
    if (pathLength(unit, X_WB) > longestLength_m(unit) + kRounding_m) return u;
  }
  return -1;
}

double Movement::length_m(int unit, double s_deg) const {
  return pathLength(model_.musculature.units[static_cast<std::size_t>(unit)], poses(s_deg, 0));
}

std::vector<std::string> Movement::stopped(double s_deg) const {
  std::vector<std::string> names;
  for (const Moved& m : moved_)
    if (halted(m, s_deg)) names.push_back("stop of " + model_.skeleton.coordinates[m.coordinate].name);
  return names;
}

bool Movement::halted(const Moved& m, double s_deg) const {
  return (m.share * s_deg / kDegPerRad - m.stop_rad) * direction_ * m.share >= -1e-12;
}

double Movement::at(const Moved& m, double s_deg) const {
  return halted(m, s_deg) ? m.stop_rad : m.share * s_deg / kDegPerRad;
}

/// Poses at s + ds, where only the coordinates that still move at s move on.
std::vector<RigidTransform> Movement::poses(double s_deg, double ds_deg) const {
  Eigen::VectorXd q = clinical(s_deg);
  for (const Moved& m : moved_)
    if (!halted(m, s_deg)) q[m.coordinate] += m.share * ds_deg / kDegPerRad;
  return segmentPoses(model_.skeleton, postureFromClinical(model_.skeleton, q));
}

void Movement::keepThoseThatStretch(double from_deg) {
  const auto start = poses(from_deg, 0), moved = poses(from_deg, direction_),
             far = poses(0.5 * (from_deg + end_deg_), 0);
  for (int u = 0; u < static_cast<int>(model_.musculature.units.size()); ++u) {
    const MusculotendonUnit& unit = model_.musculature.units[static_cast<std::size_t>(u)];
    const double length_m = pathLength(unit, start);
    const auto differs = [&](const auto& X_WB) { return std::abs(pathLength(unit, X_WB) - length_m) > 1e-9; };
    if (differs(moved) || differs(far)) units_.push_back(u);
  }
}

RomReading simulateRomTest(const Model& model, const RomTest& test, char side) {
  const Movement movement{model, test, side};
  const double direction = movement.direction();
  const auto held = [&](double s) {
    return movement.resistance_Nm(s) >= test.threshold_Nm || movement.overstretched(s) >= 0;
  };
  const double last = movement.end_deg() - direction * 1e-6;  // at the end itself nothing moves any more
  double free = test.from_deg, reached = movement.end_deg();
  bool by_muscles = held(free);
  if (by_muscles) reached = free;
  for (double next = free; !by_muscles && next != last; free = next) {
    next = free + direction * kStep_deg;
    if ((next - last) * direction > 0) next = last;
    by_muscles = held(next);
    if (by_muscles) {
      for (reached = next; std::abs(reached - free) > 1e-3;) {
        const double middle = 0.5 * (free + reached);
        (held(middle) ? reached : free) = middle;
      }
      break;
    }
  }
  RomReading reading{.test = test.id, .angle_deg = test.read_offset_deg, .moment_Nm = 0};
  reading.stopped_by_joint = !by_muscles;
  const Eigen::VectorXd clinical = movement.clinical(reached);
  for (const auto& [name, factor] : test.reads)
    reading.angle_deg += factor * clinical[sidedCoordinate(model.skeleton, name, side)] * kDegPerRad;
  const auto moments = movement.moments(by_muscles ? reached : last);
  for (const auto& [moment, unit] : moments) reading.moment_Nm += moment;
  const auto nameOfUnit = [&](int unit) { return model.musculature.units[static_cast<std::size_t>(unit)].name; };
  if (!by_muscles)
    reading.limited_by = movement.stopped(reached);
  else if (reading.moment_Nm < 0.99 * test.threshold_Nm && movement.overstretched(reached) >= 0)
    reading.limited_by = {nameOfUnit(movement.overstretched(reached)) + " (at its longest)"};
  else
    for (std::size_t i = 0; i < std::min<std::size_t>(3, moments.size()); ++i)
      if (moments[i].first > 0.05 * test.threshold_Nm) reading.limited_by.push_back(nameOfUnit(moments[i].second));
  return reading;
}

}  // namespace sinew
