#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.h"
#include "core/model/rom_preset.h"
#include "core/posture/validity.h"
#include "core/rom/tests/movement_internal.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {

Movement::Movement(const Skeleton& skeleton, const ClinicalTest& test, char side)
    : direction_{test.to_deg > test.from_deg ? 1.0 : -1.0},
      from_deg_{test.from_deg},
      // Until the stops are known the movement goes on for ever.
      end_deg_{direction_ * std::numeric_limits<double>::infinity()},
      base_{clinicalFromPosture(skeleton, test.posture(skeleton, side))},
      read_offset_deg_{test.read_offset_deg} {
  for (const auto& [name, factor] : test.reads) reads_.emplace_back(sidedCoordinate(skeleton, name, side), factor);
  for (const auto& [name, share] : test.moves) {
    Moved m{sidedCoordinate(skeleton, name, side), share, 0, 0};
    const Coordinate& c = skeleton.coordinates[std::size_t(m.coordinate)];
    m.stop_rad = share * direction_ > 0 ? c.stop_max_rad : c.stop_min_rad;
    moved_.push_back(m);
  }
  std::vector<Moved> moved = moved_;
  for (Moved& m : moved) m.stop_rad = stopInEditedRange_rad(skeleton, m);
  moved_ = std::move(moved);
  double end_deg = from_deg_;
  for (const Moved& m : moved_) {
    const double stop_deg = m.stop_rad * kDegPerRad / m.share;
    if ((stop_deg - end_deg) * direction_ > 0) end_deg = stop_deg;
  }
  if ((end_deg - test.to_deg) * direction_ > 0) end_deg = test.to_deg;
  for (Moved& m : moved_) m.end_rad = value_rad(m, end_deg);
  end_deg_ = end_deg;
}

double Movement::stopInEditedRange_rad(const Skeleton& skeleton, const Moved& m) const {
  constexpr double kStep_deg = 2;
  const Joint& joint = skeleton.joints[std::size_t(skeleton.coordinates[std::size_t(m.coordinate)].joint)];
  if (joint.edited.steps.empty()) return m.stop_rad;
  const auto holds = [&](double s_deg) {
    const Posture q = postureFromClinical(skeleton, clinical(s_deg));
    const auto R_JB = rotationFromVector<double>(q.segment<3>(joint.first_coordinate));
    return ballStopMargin_rad(skeleton, joint, R_JB) >= -1e-9;
  };
  double inside = from_deg_, outside = from_deg_;
  while (!halted(m, outside) && holds(outside)) inside = outside, outside += direction_ * kStep_deg;
  if (holds(outside)) return m.stop_rad;
  while (std::abs(outside - inside) > 1e-3) {
    const double middle = 0.5 * (inside + outside);
    (holds(middle) ? inside : outside) = middle;
  }
  return m.share * inside / kDegPerRad;
}

bool Movement::halted(const Moved& m, double s_deg) const {
  return (m.share * s_deg / kDegPerRad - m.stop_rad) * direction_ * m.share >= -1e-12;
}

bool Movement::moves(const Moved& m, double s_deg) const {
  return (s_deg - end_deg_) * direction_ >= -1e-12 || !halted(m, s_deg);
}

double Movement::value_rad(const Moved& m, double s_deg) const {
  if ((s_deg - end_deg_) * direction_ > 0) return m.end_rad + m.share * (s_deg - end_deg_) / kDegPerRad;
  return halted(m, s_deg) ? m.stop_rad : m.share * s_deg / kDegPerRad;
}

Eigen::VectorXd Movement::clinical(double s_deg) const {
  Eigen::VectorXd q = base_;
  for (const Moved& m : moved_) q[m.coordinate] = value_rad(m, s_deg);
  return q;
}

double Movement::angle_deg(double s_deg) const {
  double angle = read_offset_deg_;
  for (const auto& [coordinate, factor] : reads_) {
    const auto m = std::ranges::find(moved_, coordinate, &Moved::coordinate);
    angle += factor * kDegPerRad * (m == moved_.end() ? base_[coordinate] : value_rad(*m, s_deg));
  }
  return angle;
}

double Movement::placeOf_deg(double wanted_deg, double low_deg, double high_deg) const {
  const bool rises = angle_deg(high_deg) > angle_deg(low_deg);
  while (high_deg - low_deg > 1e-9) {
    const double middle = 0.5 * (low_deg + high_deg);
    if (middle <= low_deg || middle >= high_deg) break;
    ((angle_deg(middle) < wanted_deg) == rises ? low_deg : high_deg) = middle;
  }
  return 0.5 * (low_deg + high_deg);
}

std::vector<std::string> Movement::stopped(const Skeleton& skeleton, double s_deg) const {
  std::vector<std::string> names;
  for (const Moved& m : moved_)
    if (halted(m, s_deg)) names.push_back("stop of " + skeleton.coordinates[std::size_t(m.coordinate)].name);
  return names;
}

}  // namespace sinew
