#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/rom_preset.h"
#include "core/rom/poses/pose_set.h"
#include "core/rom/tests/clinical_tests.h"

namespace sinew {

struct PoseSampleOptions {
  int count = 72000;          ///< postures at least, mirror images included
  std::uint32_t seed = 2026;  ///< permutes the digits of the sequence
};

/// The synthetic pose set of a preset, handed out in blocks; the same options give the same postures everywhere.
/// Whole body, both sides on their own: points of a scrambled Halton sequence, every ball joint inside the ellipsoid
/// of its ranges, every hinge inside its interval; what a coupling forbids on either side is left out, and so is what
/// lies within 1 deg of a ball joint's gimbal lock, where clinical angles cannot be read. Before them come the ends
/// themselves: every range and every coupling at its limit, in the posture of its test if it has one. Every posture
/// is followed by its mirror image.
void samplePoses(const Skeleton& skeleton, const RomPreset& preset, const std::vector<ClinicalTest>& tests,
                 const PoseSampleOptions& options, const PoseVisitor& visit);

/// The same, stored.
PoseSet sampledPoseSet(const Skeleton& skeleton, const RomPreset& preset, const std::vector<ClinicalTest>& tests,
                       const PoseSampleOptions& options = {});

/// The same for the normal limits of the skeleton alone, without couplings and mirror images: to try things on.
std::vector<Posture> normalPostures(const Skeleton& skeleton, int count, std::uint32_t seed = 2026);

/// Postures in which nothing may pull: standing, neutral body posture without gravity, arms held sideways ("T").
std::vector<Posture> restingPostures(const Skeleton& skeleton);

}  // namespace sinew
