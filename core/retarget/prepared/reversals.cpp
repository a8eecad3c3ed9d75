#include "core/retarget/prepared/reversals.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/muscle/muscle_path.h"

namespace sinew {

std::vector<int> stepDirections(std::span<const double> lengths) {
  constexpr double kTenths = 10;
  const auto [low, high] = std::ranges::minmax(lengths);
  const double matters = kReversalShare * (high - low) * kTenths / double(lengths.size() - 1);
  std::vector<int> directions;
  for (std::size_t s = 0; s + 1 < lengths.size(); ++s) {
    const double step = lengths[s + 1] - lengths[s];
    directions.push_back(std::abs(step) < matters ? 0 : step > 0 ? 1 : -1);
  }
  return directions;
}

void countReversals(std::span<const int> directions, std::span<const double> lengths, StepCount& count) {
  require(directions.size() + 1 == lengths.size(), "countReversals: a direction for every step");
  for (std::size_t s = 0; s < directions.size(); ++s) {
    if (directions[s] == 0) continue;
    ++count.directed;
    count.reversed += directions[s] * (lengths[s + 1] - lengths[s]) < 0;
  }
}

std::vector<double> lengthsOver(const MusculotendonUnit& unit, std::span<const std::vector<RigidTransform>> poses) {
  std::vector<double> lengths_m;
  for (const auto& X_WB : poses) lengths_m.push_back(pathLength(unit, X_WB));
  return lengths_m;
}

}  // namespace sinew
