#pragma once
#include <random>
#include <vector>

#include "core/muscle/evaluate.h"
#include "core/rom/pose_sampler.h"
#include "tests/support/postures.h"

namespace sinew::test {

/// Random valid postures of the whole body: trunk and right limbs of one normal posture, left limbs of another's
/// mirror image, kept if no unit is beyond its longest length.
/// @param share_of_range by which all angles are brought towards standing: 1 reaches to the normal limits.
inline std::vector<Posture> validPostures(const Skeleton& skeleton, const Musculature& musculature, std::size_t count,
                                          unsigned seed, double share_of_range = 1) {
  const std::vector<Posture> half = normalPostures(skeleton, 2000);
  std::mt19937_64 random{seed};
  std::uniform_int_distribution<std::size_t> any{0, half.size() - 1};
  std::vector<Posture> postures;
  for (int trial = 0; postures.size() < count && trial < 10'000; ++trial) {
    Eigen::VectorXd clinical = clinicalFromPosture(skeleton, half[any(random)]);
    const Eigen::VectorXd other = mirroredClinical(skeleton, clinicalFromPosture(skeleton, half[any(random)]));
    for (int i = 0; i < clinical.size(); ++i)
      if (skeleton.coordinates[i].name.ends_with("_l")) clinical[i] = other[i];
    const Posture posture = postureFromClinical(skeleton, share_of_range * clinical);
    if (evaluatePosture(skeleton, musculature, posture).valid) postures.push_back(posture);
  }
  return postures;
}

}  // namespace sinew::test
