#pragma once
#include <vector>

#include "core/model/rom_preset.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

/// Postures over the whole normal range of motion: every coordinate of the joints alone from its lower to its upper
/// normal limit in steps of at most `step_deg`, the zero posture first, then `random_count` draws in which all
/// coordinates move at once inside the ellipsoids of their limits (normalPostures).
std::vector<Posture> rangePostures(const Skeleton& skeleton, double step_deg = 10, int random_count = 200);

/// Every coordinate of the joints through the preset's range in steps of at most `step_deg`, the others neutral
/// unless a coupling takes one of them along; the zero posture first.
std::vector<Posture> singleMotions(const Skeleton& skeleton, const RomPreset& preset, double step_deg = 10);

}  // namespace sinew
