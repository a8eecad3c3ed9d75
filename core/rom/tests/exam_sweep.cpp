#include "core/rom/tests/exam_sweep.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/posture/muscle_role.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kStep_deg = 1;     // a length table of this step interpolates to about 2 um
constexpr double kMargin_deg = 60;  // beyond both ends of the sweep: contractures, and slope for the solver

std::map<std::string, double> sidedPosture(const ExamTest& test, char side) {
  std::map<std::string, double> posture_deg;
  const auto add = [&](const std::map<std::string, double>& coordinates, char s) {
    for (const auto& [name, value] : coordinates) posture_deg[name + "_" + s] = value;
  };
  add(test.posture_deg, side);
  add(test.contralateral_posture_deg, side == 'r' ? 'l' : 'r');
  return posture_deg;
}

}  // namespace

ExamSweep::ExamSweep(const Model& model, const ExamTest& test, char side) : model_{&model}, test_{&test} {
  const Skeleton& skeleton = model.skeleton;
  const std::string name = test.coordinate + "_" + side;
  const Coordinate& coordinate = skeleton.coordinates[skeleton.coordinateIndex(name)];
  const int index = skeleton.coordinateIndex(name);
  direction_ = test.sweep_to_deg > test.sweep_from_deg ? 1 : -1;
  start_rad_ = test.sweep_from_deg * kRadPerDeg;
  const double end_rad = test.sweep_to_deg * kRadPerDeg;
  stop_rad_ =
      direction_ > 0 ? std::min(end_rad, coordinate.athlete_max_rad) : std::max(end_rad, coordinate.athlete_min_rad);

  const double low_deg = std::min(test.sweep_from_deg, test.sweep_to_deg) - kMargin_deg;
  const double high_deg = std::max(test.sweep_from_deg, test.sweep_to_deg) + kMargin_deg;
  const int samples = static_cast<int>(std::ceil((high_deg - low_deg) / kStep_deg)) + 1;
  table_begin_rad_ = low_deg * kRadPerDeg;
  table_step_rad_ = kStep_deg * kRadPerDeg;

  auto posture_deg = sidedPosture(test, side);
  const Kinematics at_ease = clinicalKinematics(skeleton, postureFromDegrees(skeleton, posture_deg));
  for (int u = 0; u < static_cast<int>(model.musculature.units.size()); ++u)
    if (std::ranges::count(spannedCoordinates(model.musculature.units[u], at_ease), index) > 0)
      units_.push_back({u, std::vector<double>(samples), std::vector<double>(samples)});
  for (int i = 0; i < samples; ++i) {
    posture_deg[name] = low_deg + i * kStep_deg;
    const Kinematics k = clinicalKinematics(skeleton, postureFromDegrees(skeleton, posture_deg));
    for (auto& swept : units_) {
      const MusculotendonUnit& unit = model.musculature.units[swept.unit];
      swept.length_m[i] = pathLength(unit, k.X_WB);
      swept.moment_arm_m[i] = momentArms(unit, k)[index];
    }
  }
}

double ExamSweep::resistanceOf(const SweptUnit& swept, double coordinate_rad, double length_factor) const {
  const double x = (coordinate_rad - table_begin_rad_) / table_step_rad_;
  const auto last = static_cast<double>(swept.length_m.size() - 1);
  const auto i = static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, last - 1));
  const double t = std::clamp(x - static_cast<double>(i), 0.0, 1.0);
  const double length_m = std::lerp(swept.length_m[i], swept.length_m[i + 1], t);
  const double arm_m = std::lerp(swept.moment_arm_m[i], swept.moment_arm_m[i + 1], t);
  const MusculotendonUnit& unit = model_->musculature.units[swept.unit];
  // Lengths enter the equilibrium as ratios: a unit that is f times as long behaves as this one at length / f.
  return -direction_ * arm_m * equilibrium(unit, length_m / length_factor, 0).force_N;
}

double ExamSweep::resistance_Nm(double coordinate_rad, const std::map<int, double>& length_factors) const {
  double sum = 0;
  for (const auto& swept : units_) {
    const auto factor = length_factors.find(swept.unit);
    sum += resistanceOf(swept, coordinate_rad, factor == length_factors.end() ? 1.0 : factor->second);
  }
  return sum;
}

double ExamSweep::freeAngle_rad(double threshold_Nm, const std::map<int, double>& length_factors) const {
  const auto held = [&](double x) { return resistance_Nm(x, length_factors) >= threshold_Nm; };
  const double table_end_rad =
      table_begin_rad_ + table_step_rad_ * double(units_.empty() ? 0 : units_[0].length_m.size() - 1);
  const double far = direction_ > 0 ? table_end_rad : table_begin_rad_;
  const double near = direction_ > 0 ? table_begin_rad_ : table_end_rad;
  const double stride = direction_ * 4 * table_step_rad_;
  double free = start_rad_;
  while (held(free)) {  // a contracture beyond the position of ease
    free -= stride;
    if ((free - near) * direction_ <= 0) return near;
  }
  double stopped = free;
  do {
    free = stopped;
    stopped += stride;
    if ((stopped - far) * direction_ >= 0) return far;
  } while (!held(stopped));
  for (int i = 0; i < 40 && std::abs(stopped - free) > 1e-7; ++i) {
    const double middle = (free + stopped) / 2;
    (held(middle) ? stopped : free) = middle;
  }
  return (free + stopped) / 2;
}

double ExamSweep::written_deg(double coordinate_rad) const {
  return test_->read_scale * coordinate_rad / kRadPerDeg + test_->read_offset_deg;
}

SimulatedTest ExamSweep::simulate(double threshold_Nm, const std::map<int, double>& length_factors) const {
  SimulatedTest result;
  double angle_rad = freeAngle_rad(threshold_Nm, length_factors);
  result.stopped_by_joint = (angle_rad - stop_rad_) * direction_ > 0;
  if (result.stopped_by_joint) angle_rad = stop_rad_;
  result.coordinate_deg = angle_rad / kRadPerDeg;
  result.angle_deg = written_deg(angle_rad);

  std::vector<std::pair<double, int>> shares;
  for (const auto& swept : units_) {
    const auto factor = length_factors.find(swept.unit);
    const double moment = resistanceOf(swept, angle_rad, factor == length_factors.end() ? 1.0 : factor->second);
    if (moment > 0.05 * threshold_Nm) shares.emplace_back(-moment, swept.unit);
  }
  std::ranges::sort(shares);
  for (std::size_t i = 0; i < std::min<std::size_t>(3, shares.size()); ++i)
    result.limiting_muscles.push_back(model_->musculature.units[shares[i].second].name);
  return result;
}

}  // namespace sinew
