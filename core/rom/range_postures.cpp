#include "core/rom/range_postures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rom/pose_sampler.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {

namespace {

/// `coordinate` alone from `low_rad` to `high_rad` in equal steps of at most `step_deg`.
void addMotion(const Skeleton& skeleton, int coordinate, double low_rad, double high_rad, double step_deg,
               std::vector<Posture>& postures) {
  const int steps = static_cast<int>(std::ceil((high_rad - low_rad) * 180 / std::numbers::pi / step_deg));
  for (int k = 0; k <= steps; ++k) {
    Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
    clinical[coordinate] = low_rad + (high_rad - low_rad) * k / steps;
    postures.push_back(postureFromClinical(skeleton, clinical));
  }
}

}  // namespace

std::vector<Posture> rangePostures(const Skeleton& skeleton, double step_deg, int random_count) {
  std::vector<Posture> postures{zeroPosture(skeleton)};
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    const Coordinate& c = skeleton.coordinates[static_cast<std::size_t>(i)];
    if (skeleton.joints[static_cast<std::size_t>(c.joint)].type == JointType::Free) continue;
    addMotion(skeleton, i, c.normal_min_rad, c.normal_max_rad, step_deg, postures);
  }
  for (auto& q : normalPostures(skeleton, random_count)) postures.push_back(std::move(q));
  return postures;
}

std::vector<Posture> singleMotions(const Skeleton& skeleton, const RomPreset& preset, double step_deg) {
  std::vector<Posture> postures{zeroPosture(skeleton)};
  const std::vector<SidedBound> bounds = sidedBounds(skeleton, preset);
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    double low_rad = -std::numbers::pi, high_rad = std::numbers::pi;
    bool bounded = false;
    for (const SidedBound& bound : bounds)
      for (const auto& [coordinate, factor] : bound.terms) {
        if (coordinate != i) continue;
        bounded = true;
        const double end_rad = bound.limit_rad / factor;  // of a coupling: the others are 0
        (factor > 0 ? high_rad : low_rad) = factor > 0 ? std::min(high_rad, end_rad) : std::max(low_rad, end_rad);
      }
    if (bounded) addMotion(skeleton, i, low_rad, high_rad, step_deg, postures);
  }
  return postures;
}

}  // namespace sinew
