#include "core/rom/range_postures.h"

#include <cmath>
#include <numbers>

#include "core/rom/pose_sampler.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {

std::vector<Posture> rangePostures(const Skeleton& skeleton, double step_deg, int random_count) {
  std::vector<Posture> postures{zeroPosture(skeleton)};
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    const Coordinate& c = skeleton.coordinates[static_cast<std::size_t>(i)];
    if (skeleton.joints[static_cast<std::size_t>(c.joint)].type == JointType::Free) continue;
    const double range_rad = c.normal_max_rad - c.normal_min_rad;
    const int steps = static_cast<int>(std::ceil(range_rad * 180 / std::numbers::pi / step_deg));
    for (int k = 0; k <= steps; ++k) {
      Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
      clinical[i] = c.normal_min_rad + range_rad * k / steps;
      postures.push_back(postureFromClinical(skeleton, clinical));
    }
  }
  for (auto& q : normalPostures(skeleton, random_count)) postures.push_back(std::move(q));
  return postures;
}

}  // namespace sinew
