#pragma once
#include <numbers>

namespace sinew {

// Angles are radians inside the program; degrees are for files that people write, the screen and the report.
inline constexpr double kRadPerDeg = std::numbers::pi / 180;
inline constexpr double kDegPerRad = 180 / std::numbers::pi;

}  // namespace sinew
