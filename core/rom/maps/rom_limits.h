#pragma once
#include <string>
#include <vector>

#include "core/model/model.h"

namespace sinew {

/// How far one clinical coordinate of a joint goes from a posture, and what ends it there.
struct RomLimit {
  std::string coordinate;
  double low_rad = 0, high_rad = 0;  ///< NaN if no value is free
  std::string low_by, high_by;       ///< a unit, or "stop"
};

/// Of every coordinate of a joint, one after the other from `held`. See muscleInducedRange().
std::vector<RomLimit> romLimits(const Model& model, int joint, const Posture& held);

}  // namespace sinew
