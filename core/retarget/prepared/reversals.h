#pragma once
#include <span>
#include <vector>

#include "core/muscle/musculature.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// Ryu et al., Muscle Routing Evaluation: functional disorders, "increasing-to-decreasing and vice versa". A
// length-angle curve is cut into steps; one that is more than a small share of the reference's range has a direction
// there, and is reversed if it goes the other way in the new body.

/// Steps that a motion is cut into.
inline constexpr int kReversalSteps = 40;
/// A tenth of a motion in which a curve changes by less than this share of its range has no direction: next to an
/// extremum. Of shorter steps as much less is asked.
inline constexpr double kReversalShare = 0.02;

struct StepCount {
  int reversed = 0, directed = 0;
  double share() const { return directed ? double(reversed) / directed : 0; }
};

/// By step of the reference's curve: +1 where it lengthens, -1 where it shortens, 0 where it has no direction.
std::vector<int> stepDirections(std::span<const double> lengths);

/// Adds the steps of a curve with as many samples.
void countReversals(std::span<const int> directions, std::span<const double> lengths, StepCount& count);

/// Lengths of a unit at the poses of all segments [m].
std::vector<double> lengthsOver(const MusculotendonUnit& unit, std::span<const std::vector<RigidTransform>> poses);

}  // namespace sinew
