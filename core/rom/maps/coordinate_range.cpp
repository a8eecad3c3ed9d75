#include "core/rom/maps/coordinate_range.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/posture/muscle_role.h"
#include "core/posture/validity.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kSample_rad = 3 * kRadPerDeg;
constexpr int kBisections = 9;  // 3 deg / 2^9 = 0.006 deg

/// The unit with the least length to spare when one coordinate takes a value; or that pulls most, where the passive
/// moment is the examiner's.
struct Tightest {
  double margin_m = INFINITY;
  int unit = -1;
  bool by_moment = false;
  bool isFree() const { return margin_m >= 0 && !by_moment; }
};

class Sweep {
 public:
  Sweep(const Model& model, const Eigen::VectorXd& clinical, int coordinate, std::vector<int> units,
        double examiner_Nm)
      : model_{model},
        clinical_{clinical},
        coordinate_{coordinate},
        units_{std::move(units)},
        examiner_Nm_{examiner_Nm} {
    for (const int i : units_) longest_m_.push_back(longestLength_m(model.musculature.units[std::size_t(i)]));
  }

  Tightest at(double value_rad) {
    clinical_[coordinate_] = value_rad;
    const Posture q = postureFromClinical(model_.skeleton, clinical_);
    if (beyondEditedRange(q)) return {-INFINITY, -1};
    const auto X_WB = segmentPoses(model_.skeleton, q);
    Tightest tightest;
    for (std::size_t i = 0; i < units_.size(); ++i) {
      const auto& unit = model_.musculature.units[std::size_t(units_[i])];
      const double margin_m = longest_m_[i] - pathLength(unit, X_WB);
      if (margin_m < tightest.margin_m) tightest = {margin_m, units_[i]};
    }
    if (tightest.isFree() && std::isfinite(examiner_Nm_)) examine(value_rad, tightest);
    return tightest;
  }

  /// Between a free value and one that is not: the last free one, and what ends it.
  std::pair<double, Tightest> border(double free_rad, double held_rad) {
    Tightest end = at(held_rad);
    for (int i = 0; i < kBisections; ++i) {
      const double middle_rad = (free_rad + held_rad) / 2;
      const Tightest tightest = at(middle_rad);
      if (tightest.isFree()) {
        free_rad = middle_rad;
      } else {
        held_rad = middle_rad;
        end = tightest;
      }
    }
    return {free_rad, end};
  }

 private:
  /// Sum of the passive moments of muscles, capsule and ligaments about the coordinate.
  void examine(double value_rad, Tightest& tightest) {
    constexpr double kAside_rad = 1e-4;  // central difference: dl/dq good to a micrometre a radian
    const auto posesAt = [&](double value) {
      clinical_[coordinate_] = value;
      return segmentPoses(model_.skeleton, postureFromClinical(model_.skeleton, clinical_));
    };
    const auto before = posesAt(value_rad - kAside_rad), after = posesAt(value_rad + kAside_rad);
    const auto here = posesAt(value_rad);
    double sum_Nm = model_.passive_moments.empty()
                        ? 0
                        : passiveMoment_Nm(model_.passive_moments[std::size_t(coordinate_)], value_rad);
    std::vector<std::pair<double, int>> shares{{sum_Nm, -1}};
    for (const int i : units_) {
      const MusculotendonUnit& unit = model_.musculature.units[std::size_t(i)];
      const double force_N = equilibrium(unit, pathLength(unit, here), 0).force_N;
      if (force_N == 0) continue;
      const double slope_m_rad = (pathLength(unit, after) - pathLength(unit, before)) / (2 * kAside_rad);
      shares.emplace_back(-slope_m_rad * force_N, i);
      sum_Nm += shares.back().first;
    }
    if (std::abs(sum_Nm) < examiner_Nm_) return;
    tightest.by_moment = true;
    tightest.unit =
        std::ranges::max_element(shares, {}, [&](const auto& s) { return sum_Nm > 0 ? s.first : -s.first; })->second;
  }

  /// The interval of a coordinate is only the box about an edited range.
  bool beyondEditedRange(const Posture& q) const {
    const Joint& joint = model_.skeleton.joints[std::size_t(model_.skeleton.coordinates[coordinate_].joint)];
    if (joint.edited.steps.empty()) return false;
    const auto R_JB = rotationFromVector<double>(q.segment<3>(joint.first_coordinate));
    return ballStopMargin_rad(model_.skeleton, joint, R_JB) < -1e-9;
  }

  const Model& model_;
  Eigen::VectorXd clinical_;
  int coordinate_;
  std::vector<int> units_;
  double examiner_Nm_;
  std::vector<double> longest_m_;
};

/// Values to try, rising, the present one among them.
std::vector<double> samples(const Coordinate& c, double present_rad) {
  const double width_rad = c.stop_max_rad - c.stop_min_rad;
  const int steps = std::max(1, int(std::ceil(width_rad / kSample_rad)));
  std::vector<double> values;
  for (int i = 0; i <= steps; ++i) values.push_back(std::lerp(c.stop_min_rad, c.stop_max_rad, double(i) / steps));
  if (present_rad > c.stop_min_rad && present_rad < c.stop_max_rad) {
    values.push_back(present_rad);
    std::ranges::sort(values);
  }
  return values;
}

CoordinateRange rangeOver(Sweep sweep, const Coordinate& c, int coordinate, double present_rad) {
  const auto values = samples(c, present_rad);
  std::vector<bool> is_free;
  for (const double value : values) is_free.push_back(sweep.at(value).isFree());
  // The free sample nearest to the present value begins the interval.
  int start = -1;
  for (int i = 0; i < int(values.size()); ++i)
    if (is_free[std::size_t(i)] && (start < 0 || std::abs(values[std::size_t(i)] - present_rad) <
                                                     std::abs(values[std::size_t(start)] - present_rad)))
      start = i;
  CoordinateRange range{.coordinate = coordinate};
  if (start < 0) {
    range.high_unit = sweep.at(present_rad).unit;
    return range;
  }
  int first = start, last = start;
  while (first > 0 && is_free[std::size_t(first - 1)]) --first;
  while (last + 1 < int(values.size()) && is_free[std::size_t(last + 1)]) ++last;
  range.low_rad = values[std::size_t(first)];
  range.high_rad = values[std::size_t(last)];
  if (first > 0) {
    const auto [end_rad, by] = sweep.border(range.low_rad, values[std::size_t(first - 1)]);
    range.low_rad = end_rad, range.low_unit = by.unit, range.low_by_moment = by.by_moment;
  }
  if (last + 1 < int(values.size())) {
    const auto [end_rad, by] = sweep.border(range.high_rad, values[std::size_t(last + 1)]);
    range.high_rad = end_rad, range.high_unit = by.unit, range.high_by_moment = by.by_moment;
  }
  return range;
}

/// Units by the coordinate that stretches them.
std::vector<std::vector<int>> unitsByCoordinate(const Model& model, const Eigen::VectorXd& clinical) {
  const Kinematics k = clinicalKinematics(model.skeleton, postureFromClinical(model.skeleton, clinical));
  std::vector<std::vector<int>> units(model.skeleton.coordinates.size());
  for (int i = 0; i < int(model.musculature.units.size()); ++i)
    for (const int c : spannedCoordinates(model.musculature.units[std::size_t(i)], k))
      units[std::size_t(c)].push_back(i);
  return units;
}

}  // namespace

CoordinateRange muscleInducedRange(const Model& model, const Eigen::VectorXd& clinical, int coordinate,
                                   double examiner_Nm) {
  const Coordinate& c = model.skeleton.coordinates[std::size_t(coordinate)];
  require(!c.translational, "muscleInducedRange: an angle");
  auto units = unitsByCoordinate(model, clinical)[std::size_t(coordinate)];
  return rangeOver({model, clinical, coordinate, std::move(units), examiner_Nm}, c, coordinate, clinical[coordinate]);
}

std::vector<CoordinateRange> muscleInducedRanges(const Model& model, const Eigen::VectorXd& clinical, const Job& job,
                                                 const std::vector<double>& examiner_Nm) {
  auto units = unitsByCoordinate(model, clinical);
  std::vector<CoordinateRange> ranges;
  for (int i = 0; i < model.skeleton.coordinateCount(); ++i) {
    const Coordinate& c = model.skeleton.coordinates[std::size_t(i)];
    if (c.joint == 0) continue;
    if (job.cancelled()) return {};
    const double stops_Nm = examiner_Nm.empty() ? INFINITY : examiner_Nm[std::size_t(i)];
    ranges.push_back(rangeOver({model, clinical, i, std::move(units[std::size_t(i)]), stops_Nm}, c, i, clinical[i]));
  }
  return ranges;
}

}  // namespace sinew
