#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "core/kernel/compiled_model.h"
#include "core/kernel/pose_table.h"
#include "core/kernel/precision.h"

namespace sinew {

// One pass over any number of postures that keeps only what is asked of all of them. Memory does not grow with their
// number, but for the one byte of each posture's validity.

/// Fills the table with the postures from number `first` on, as many as it has room for. May be asked for some twice.
using PostureReader = std::function<void(std::size_t first, PoseTable& postures)>;

struct PostureSweep {
  std::vector<double> longest_m;      ///< by unit
  std::vector<long> longest_posture;  ///< number of the posture that has it
  std::vector<std::uint8_t> valid;    ///< by posture: no unit beyond its longest length
  std::size_t validCount() const;
};

/// In single precision longest paths are within 0.01 mm of the true maximum and exact for the posture named; whoever
/// is within 5 um of the limit is asked again in double: validity is the same.
PostureSweep sweepPostures(const CompiledModel& model, std::size_t count, const PostureReader& read,
                           Precision precision = Precision::Double);

}  // namespace sinew
