#pragma once
#include <random>
#include <vector>

#include "core/posture/evaluate.h"
#include "core/rom/poses/pose_sampler.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew::test {

/// Random postures of the average adult's pose set, kept if no unit is beyond its longest length.
inline std::vector<Posture> validPostures(const Skeleton& skeleton, const Musculature& musculature, std::size_t count,
                                          unsigned seed) {
  const RomPreset preset = loadRomPreset(resourceDir(), kDefaultPreset, skeleton);
  const PoseSet set =
      sampledPoseSet(skeleton, preset, loadClinicalTests(resourceDir(), skeleton).tests, {.count = 4000});
  std::mt19937_64 random{seed};
  std::uniform_int_distribution<std::size_t> any{0, set.size() - 1};
  std::vector<Posture> postures;
  for (int trial = 0; postures.size() < count && trial < 10'000; ++trial) {
    const Posture posture = set.posture(any(random));
    if (evaluatePosture(skeleton, musculature, posture).valid) postures.push_back(posture);
  }
  return postures;
}

}  // namespace sinew::test
