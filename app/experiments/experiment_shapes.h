#pragma once
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/skeleton/shape/shape.h"

namespace sinew {

// Bodies that the experiments ask about.

/// All four limb bones of both sides as many times as long (Ryu et al., Muscle Routing Evaluation).
ShapeParameters withLimbElongation(double ratio);

/// Both femora longer and twisted (Ryu et al., ROM Construction).
ShapeParameters withFemora(double elongation, double torsion_rad);

/// Ranges that random bodies are drawn from, evenly: elongation and torsion of every limb bone, each side on its own,
/// elongation of trunk and neck.
struct ShapeRanges {
  double least_elongation = 0.7, greatest_elongation = 1.3;
  double greatest_torsion_rad = 30 * std::numbers::pi / 180;
};
/// What is called a mild change of shape.
inline constexpr ShapeRanges kMildShapes{0.8, 1.3, 20 * std::numbers::pi / 180};

/// The same bodies with every library and processor.
std::vector<ShapeParameters> randomShapes(int count, const ShapeRanges& ranges, std::uint64_t seed);

}  // namespace sinew
