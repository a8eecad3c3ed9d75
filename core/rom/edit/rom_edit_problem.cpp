#include <cmath>
#include <map>

#include "core/rom/edit/rom_edit_problem_internal.h"

namespace sinew {
namespace {

ThresholdColumn mergedColumn(const ThresholdColumn& one, const ThresholdColumn& other, std::uint32_t first_sample) {
  ThresholdColumn merged;
  std::size_t i = 0, k = 0;
  while (i < one.value.size() || k < other.value.size()) {
    const bool first = k == other.value.size() || (i < one.value.size() && one.value[i] <= other.value[k]);
    merged.value.push_back(first ? one.value[i] : other.value[k]);
    merged.sample.push_back(first ? one.sample[i] : other.sample[k] + first_sample);
    ++(first ? i : k);
  }
  return merged;
}

/// A fourth of the cells of a map, evenly over twists and directions, its own mirror image.
bool isOfLattice(std::size_t cell) {
  const std::size_t azimuth = cell % RomMap::kAzimuths, polar = cell / RomMap::kAzimuths % RomMap::kPolars,
                    twist = cell / (RomMap::kAzimuths * RomMap::kPolars);
  return (azimuth + 2 * polar + twist) % 4 == 0;
}

/// Within the new stops muscles do what muscles and stops together are to do, beyond them what muscles are to do
/// alone.
void appendSamples(const JointGoal& goal, double weight_alone, ThresholdProblem& problem) {
  const JointCells& cells = *goal.cells;
  for (std::size_t s = 0; s < cells.sampleCount(); ++s) {
    const std::size_t cell = s % cells.cellCount();
    const double together = goal.stops[cell] ? (goal.isWanted(s) ? 1 : -1) : 0;
    // Beyond the stops every fourth cell stands for four.
    const double share = together != 0 || !cells.isBall() ? 1 : isOfLattice(cell) ? 4 : 0;
    const double worth = together + share * weight_alone * (goal.muscles[s] ? 1 : -1);
    problem.wanted.push_back(worth > 0);
    problem.weight.push_back(cells.held()[s / cells.cellCount()].weight * std::abs(worth));
  }
}

}  // namespace

JoinedProblem joinedProblem(const std::vector<JointGoal>& goals, double weight_alone) {
  static const ThresholdColumn kNone;
  std::map<int, const ThresholdColumn*> by_unit;
  JoinedProblem joined;
  for (const JointGoal& goal : goals) {
    const JointCells& cells = *goal.cells;
    const auto first = static_cast<std::uint32_t>(joined.problem.wanted.size());
    for (std::size_t i = 0; i < cells.units().size(); ++i) {
      const ThresholdColumn*& column = by_unit.try_emplace(cells.units()[i], &kNone).first->second;
      const ThresholdColumn& own = cells.columns()[i];
      column = first == 0 ? &own : &joined.merged.emplace_back(mergedColumn(*column, own, first));
    }
    appendSamples(goal, weight_alone, joined.problem);
  }
  for (const auto& [unit, column] : by_unit) {
    joined.units.push_back(unit);
    joined.problem.columns.push_back(column);
  }
  return joined;
}

}  // namespace sinew
