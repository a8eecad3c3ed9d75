#pragma once
#include <array>
#include <vector>

#include "core/rom/rom_edit_cells_internal.h"

namespace sinew {

/// Stops of a ball joint: an interval for each clinical angle. An edited cone is no such box; the one that differs
/// least from what is wanted is fitted.
struct StopBox {
  Eigen::Vector3d min_rad, max_rad;
  /// Under either reading, as ballStopMargin_rad().
  bool holds(const std::array<Eigen::Vector3d, 2>& readings) const;
};

StopBox stopBoxOf(const Skeleton& skeleton, int joint);

/// Where the six ends go if each is taken alone through T^-1: what fits begin from and prefer.
StopBox carriedStopBox(const Skeleton& skeleton, const RomTransform& transform, int joint);

/// One end after the other to its best place until none moves. `gain`: by cell, what it is worth to hold it
/// (negative: to exclude it). An end stays at `reference` if that costs nothing, else it is the best value nearest to
/// `carried`.
StopBox fittedStopBox(const JointCells& cells, const std::vector<double>& gain, const StopBox& start,
                      const StopBox& reference, const StopBox& carried);

}  // namespace sinew
