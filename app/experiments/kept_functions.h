#pragma once
#include <string>
#include <vector>

#include "core/model/model.h"

namespace sinew {

class RetargetReference;

// Whether muscles still do in a new body what they do in the reference, whose own functions are what is asked for.

/// A unit that in the reference shortens over a motion by at least 2 mm (muscleFunctions()), or turns its coordinate
/// at half way with an arm of at least 5 mm.
struct KeptFunctions {
  int shortenings = 0, shortenings_kept = 0;
  int moment_arms = 0, moment_arms_kept = 0;
  std::vector<std::string> lost;  ///< "psoas_r, hip flexion"

  double share() const {
    const int all = shortenings + moment_arms;
    return all ? double(shortenings_kept + moment_arms_kept) / all : 1;
  }
};

KeptFunctions keptFunctions(const RetargetReference& reference, const Model& body);

}  // namespace sinew
