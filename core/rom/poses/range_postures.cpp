#include "core/rom/poses/range_postures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rom/poses/pose_sampler.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {

namespace {

/// Values of one coordinate from `low_rad` to `high_rad` in equal steps of at most `step_deg`.
std::vector<double> steps(double low_rad, double high_rad, double step_deg) {
  const int count = static_cast<int>(std::ceil((high_rad - low_rad) * 180 / std::numbers::pi / step_deg));
  std::vector<double> values;
  for (int k = 0; k <= count; ++k) values.push_back(low_rad + (high_rad - low_rad) * k / count);
  return values;
}

/// Where `moved` is beyond the end of a coupling, the first of the others takes it there: the girdle rises with the
/// arm, the knee bends with the thigh.
void follow(int moved, const std::vector<SidedBound>& bounds, Eigen::VectorXd& clinical) {
  for (const SidedBound& bound : bounds) {
    const auto names = [&](const auto& term) { return term.first == moved; };
    if (bound.terms.size() < 2 || std::ranges::none_of(bound.terms, names) || bound.excess_rad(clinical) <= 0)
      continue;
    const auto [other, factor] = *std::ranges::find_if_not(bound.terms, names);
    clinical[other] -= bound.excess_rad(clinical) / factor;
  }
}

}  // namespace

std::vector<Posture> rangePostures(const Skeleton& skeleton, double step_deg, int random_count) {
  std::vector<Posture> postures{zeroPosture(skeleton)};
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    const Coordinate& c = skeleton.coordinates[static_cast<std::size_t>(i)];
    if (skeleton.joints[static_cast<std::size_t>(c.joint)].type == JointType::Free) continue;
    for (const double value_rad : steps(c.normal_min_rad, c.normal_max_rad, step_deg)) {
      Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
      clinical[i] = value_rad;
      postures.push_back(postureFromClinical(skeleton, clinical));
    }
  }
  for (auto& q : normalPostures(skeleton, random_count)) postures.push_back(std::move(q));
  return postures;
}

std::vector<Posture> singleMotions(const Skeleton& skeleton, const RomPreset& preset, double step_deg) {
  std::vector<Posture> postures{zeroPosture(skeleton)};
  Skeleton within = skeleton;
  setStops(within, preset);
  const std::vector<SidedBound> bounds = sidedBounds(skeleton, preset);
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    const Coordinate& c = within.coordinates[static_cast<std::size_t>(i)];
    if (skeleton.joints[static_cast<std::size_t>(c.joint)].type == JointType::Free) continue;
    for (const double value_rad : steps(c.stop_min_rad, c.stop_max_rad, step_deg)) {
      Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
      clinical[i] = value_rad;
      follow(i, bounds, clinical);
      postures.push_back(postureFromClinical(skeleton, clinical));
    }
  }
  return postures;
}

}  // namespace sinew
