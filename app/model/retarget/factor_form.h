#pragma once
#include <string>
#include <vector>

#include "core/muscle/musculature.h"
#include "core/skeleton/shape/body_description.h"

namespace sinew {

/// How the mass of a part of the body is given.
enum class MassRule {
  Volume,  ///< as its deformed volume weighs
  Factor,  ///< times that
  Ratio    ///< over the reference's mass, whatever the volume
};
struct PartMass {
  MassRule rule = MassRule::Volume;
  double value = 1;
  bool mixed = false;  ///< its segments do not agree; the first one's is shown
};

/// Parts that the form lists: "pelvis", "trunk", "neck", ..., both sides at once.
const std::vector<std::string>& massFormParts();
PartMass partMass(const PhysicsFactors& factors, const std::string& part);
void setPartMass(PhysicsFactors& factors, const std::string& part, MassRule rule, double value);

/// Names that a strength factor may be given to: all, groups, muscles; then single units.
std::vector<std::string> strengthNames(const Musculature& musculature);

}  // namespace sinew
