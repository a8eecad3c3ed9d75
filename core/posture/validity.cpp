#include "core/posture/validity.h"

#include <algorithm>
#include <numbers>

#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/posture/range_image.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

ConstraintMargin stopMargin(const Coordinate& c, int index, double value_rad) {
  const double below = value_rad - c.stop_min_rad, above = c.stop_max_rad - value_rad;
  const double margin = std::min(below, above);
  return {ConstraintKind::JointStop, index, above <= below, margin, margin};
}

/// Margins of the coordinates of one ball joint under one reading of its orientation; of an edited range those of its
/// image within the stops before.
std::vector<ConstraintMargin> margins(const Skeleton& skeleton, const Joint& joint, const Eigen::Vector3d& angles) {
  std::vector<ConstraintMargin> result;
  for (int i = 0; i < 3; ++i) {
    const int index = joint.first_coordinate + i;
    Coordinate c = skeleton.coordinates[index];
    if (!joint.edited.steps.empty())
      c.stop_min_rad = joint.edited.stop_min_rad[i], c.stop_max_rad = joint.edited.stop_max_rad[i];
    result.push_back(stopMargin(c, index, angles[i]));
  }
  return result;
}

/// Of an orientation that is no image of any: as far outside as can be.
std::vector<ConstraintMargin> noMargins(const Joint& joint) {
  std::vector<ConstraintMargin> result;
  for (int i = 0; i < 3; ++i)
    result.push_back(
        {ConstraintKind::JointStop, joint.first_coordinate + i, true, -std::numbers::pi, -std::numbers::pi});
  return result;
}

double least(const std::vector<ConstraintMargin>& margins) {
  return std::ranges::min(margins, {}, &ConstraintMargin::margin).margin;
}

/// Under the reading that lies deeper inside the stops.
std::vector<ConstraintMargin> ballMargins(const Skeleton& skeleton, const Joint& joint, Eigen::Matrix3d R_JB) {
  if (!joint.edited.steps.empty()) {
    const auto image = ballImage(joint.edited, R_JB);
    if (!image) return noMargins(joint);
    R_JB = *image;
  }
  const auto readings = clinicalReadings(skeleton, joint, R_JB);
  const auto one = margins(skeleton, joint, readings[0]), other = margins(skeleton, joint, readings[1]);
  return least(one) >= least(other) ? one : other;
}

}  // namespace

double ballStopMargin_rad(const Skeleton& skeleton, const Joint& joint, const Eigen::Matrix3d& R_JB) {
  return least(ballMargins(skeleton, joint, R_JB));
}

std::vector<ConstraintMargin> stopMargins(const Skeleton& skeleton, const Posture& posture) {
  std::vector<ConstraintMargin> result;
  for (const Joint& joint : skeleton.joints) {
    if (joint.type == JointType::Free) continue;
    const int first = joint.first_coordinate;
    if (joint.type == JointType::Revolute) {
      result.push_back(stopMargin(skeleton.coordinates[first], first, posture[first]));
      continue;
    }
    const auto better = ballMargins(skeleton, joint, rotationFromVector<double>(posture.segment<3>(first)));
    result.insert(result.end(), better.begin(), better.end());
  }
  return result;
}

std::vector<ConstraintMargin> constraintMargins(const Skeleton& skeleton, const Musculature& musculature,
                                                const Posture& posture) {
  const auto X_WB = segmentPoses(skeleton, posture);
  std::vector<ConstraintMargin> result;
  result.reserve(musculature.units.size() + static_cast<std::size_t>(skeleton.coordinateCount()));
  for (const MusculotendonUnit& unit : musculature.units) {
    const double margin = longestLength_m(unit) - pathLength(unit, X_WB);
    result.push_back({ConstraintKind::MuscleLength, static_cast<int>(result.size()), true, margin,
                      margin / unit.optimal_fiber_length_m});
  }
  const auto stops = stopMargins(skeleton, posture);
  result.insert(result.end(), stops.begin(), stops.end());
  return result;
}

Validity validityOf(const std::vector<ConstraintMargin>& margins) {
  Validity v;
  for (const auto& m : margins)
    if (!m.holds()) v.violated.push_back(m);
  std::ranges::stable_sort(v.violated, {}, &ConstraintMargin::relative);
  v.valid = v.violated.empty();
  if (!v.valid)
    v.first = v.violated.front();
  else if (!margins.empty())
    v.first = std::ranges::min(margins, {}, &ConstraintMargin::relative);
  return v;
}

Validity validity(const Skeleton& skeleton, const Musculature& musculature, const Posture& posture) {
  return validityOf(constraintMargins(skeleton, musculature, posture));
}

std::string nameOf(const ConstraintMargin& constraint, const Skeleton& skeleton, const Musculature& musculature) {
  if (constraint.kind == ConstraintKind::MuscleLength)
    return musculature.units[static_cast<std::size_t>(constraint.index)].name;
  return skeleton.coordinates[static_cast<std::size_t>(constraint.index)].name +
         (constraint.upper ? " (stop, max)" : " (stop, min)");
}

}  // namespace sinew
