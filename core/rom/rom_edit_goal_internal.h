#pragma once
#include <cstdint>
#include <vector>

#include "core/rom/rom_edit_cells_internal.h"
#include "core/rom/rom_edit_stops_internal.h"
#include "core/rom/rom_edit_target.h"

namespace sinew {

/// What an edit asks of one joint, and the stops that come nearest to it.
struct JointGoal {
  const JointCells* cells = nullptr;
  std::vector<std::uint8_t> muscles;  ///< by sample: the reference's muscles allow its image
  std::vector<std::uint8_t> stops;    ///< by cell: the reference's stops allow its image
  StopBox box;                        ///< new stops of a ball joint
  HingeStops hinge;                   ///< of a hinge: exact
  std::vector<std::uint8_t> inside;   ///< by cell: the new stops hold

  bool isWanted(std::size_t sample) const { return muscles[sample] && stops[sample % stops.size()]; }
};

JointGoal goalOf(const Model& reference, const RomTransform& transform, const JointCells& cells);

/// New stops of a ball joint once its muscles are known: by sample, whether they allow it. Nothing for a hinge.
void refineStops(const Model& reference, const RomTransform& transform, const std::vector<std::uint8_t>& allowed,
                 JointGoal& goal);

}  // namespace sinew
