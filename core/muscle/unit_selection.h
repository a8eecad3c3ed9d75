#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/muscle/musculature.h"

namespace sinew {

/// The units that a person means by a name: a unit ("soleus_medial_r"), a unit of both sides ("soleus_medial"), a
/// muscle
/// ("soleus": all its parts), a group ("triceps_surae"), or "all"; muscle and group with _r or _l for one side.
/// @throws InputError with the nearest names.
std::vector<int> unitsNamed(const Musculature& musculature, const std::string& name);

/// Factor by unit from factors by such names. The name that means fewer units wins.
/// @param without value of the units that are not named.
std::vector<double> factorsByUnit(const Musculature& musculature, const std::map<std::string, double>& factors,
                                  double without);

}  // namespace sinew
