#pragma once
#include <vector>

#include "core/skeleton/kinematics.h"

namespace sinew {

/// Clinical coordinates drawn evenly inside the athlete envelope, the pelvis near its place; the same everywhere.
std::vector<Posture> benchPostures(const Skeleton& skeleton, std::size_t count);

}  // namespace sinew
