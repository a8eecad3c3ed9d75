#pragma once
#include <vector>

#include "core/job.h"
#include "core/model/rom_preset.h"
#include "core/rom/poses/length_estimation.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/rom/tests/clinical_sweep.h"

namespace sinew {

// The muscle lengths of a preset. Ryu et al.: from the pose set, then lengthened where the key postures would make
// them pull; fibres should still work where one coordinate of the skeleton, in its normal range, makes them shortest.
// A pose set only says that a posture was reached, not with what effort; so the clinical tests are key postures too,
// with the examiner's moment as their threshold: all the way to the angle that people reach, the passive moment may
// not exceed it. Units that pull against the movement more than a common share of their F_max are lengthened (ratio
// kept) to that share, which is as large as the threshold allows: one number a posture, none a muscle. Lengthening
// keeps every posture of the set valid. Capsules and ligaments are left aside: they come on top, at the ends of the
// ranges (docs/methods/passive_structures.md).

struct PresetFitOptions {
  PoseSampleOptions poses;
  double step_deg = 3;   ///< between the postures along a test
  int most_rounds = 10;  ///< over all tests: they share units
};

struct PresetFit {
  std::vector<LengthEstimate> lengths;
  Model model;                          ///< skeleton with the preset's stops, muscles with these lengths; no bones
  std::vector<SimulatedTest> readings;  ///< of the preset's targets, in their order
  int rounds = 0;                       ///< over the tests, until nothing needed to be lengthened
};

/// `published`: muscles with their published fibre and tendon lengths, right half then left half.
PresetFit fitPreset(const Skeleton& skeleton, const Musculature& published, const RomPreset& preset,
                    const ClinicalTests& tests, const PresetFitOptions& options = {}, const Job& job = {});

}  // namespace sinew
