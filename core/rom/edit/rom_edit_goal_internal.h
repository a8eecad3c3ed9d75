#pragma once
#include <cstdint>
#include <vector>

#include "core/rom/edit/rom_edit_cells_internal.h"
#include "core/rom/edit/rom_edit_target.h"

namespace sinew {

/// What an edit asks of one joint.
struct JointGoal {
  const JointCells* cells = nullptr;
  std::vector<std::uint8_t> muscles;  ///< by sample: the reference's muscles allow its image
  std::vector<std::uint8_t> stops;    ///< by cell: the reference's stops allow its image: the new stops hold, exactly
  HingeStops hinge;                   ///< new stops of a hinge

  bool isWanted(std::size_t sample) const { return muscles[sample] && stops[sample % stops.size()]; }
};

JointGoal goalOf(const Model& reference, const RomTransform& transform, const JointCells& cells);

}  // namespace sinew
