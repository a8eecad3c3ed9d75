#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/skeleton/skeleton.h"

namespace sinew {

// Deformities as a clinic sees them, made by moving the landmarks and joints of a body by laws of their own (quintic
// steps, turns about points of the bone), not by the model's shape parameters. `amount` is degrees or millimetres;
// negative ones are the opposite deformity. Side 0 is right, 1 left.

struct Deformity {
  std::string name;
  std::string unit;  ///< of the amount: "deg", "mm", "%"
  std::vector<double> amounts;
  std::function<void(Skeleton& body, double amount, int side)> apply;
  bool both_sides = false;
  bool used_for_design = true;  ///< false: kept aside while the model was designed
};

const std::vector<Deformity>& deformities();

}  // namespace sinew
