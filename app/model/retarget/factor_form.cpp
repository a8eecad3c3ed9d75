#include "app/model/retarget/factor_form.h"

#include <set>

#include "core/skeleton/shape/shape_json.h"

namespace sinew {
namespace {

PartMass segmentMass(const PhysicsFactors& factors, const std::string& segment) {
  if (const auto ratio = factors.mass_ratios.find(segment); ratio != factors.mass_ratios.end())
    return {MassRule::Ratio, ratio->second};
  if (const auto factor = factors.mass_factors.find(segment); factor != factors.mass_factors.end())
    return {MassRule::Factor, factor->second};
  return {};
}

}  // namespace

const std::vector<std::string>& massFormParts() {
  static const std::vector<std::string> parts = {"trunk", "pelvis", "neck",    "head", "femur",
                                                 "tibia", "foot",   "humerus", "ulna", "hand"};
  return parts;
}

PartMass partMass(const PhysicsFactors& factors, const std::string& part) {
  const auto segments = segmentsOfPart(part);
  PartMass mass = segmentMass(factors, segments.front());
  for (const auto& segment : segments) {
    const PartMass other = segmentMass(factors, segment);
    mass.mixed |= other.rule != mass.rule || other.value != mass.value;
  }
  return mass;
}

void setPartMass(PhysicsFactors& factors, const std::string& part, MassRule rule, double value) {
  for (const auto& segment : segmentsOfPart(part)) {
    factors.mass_factors.erase(segment);
    factors.mass_ratios.erase(segment);
    if (rule == MassRule::Factor) factors.mass_factors[segment] = value;
    if (rule == MassRule::Ratio) factors.mass_ratios[segment] = value;
  }
}

std::vector<std::string> strengthNames(const Musculature& musculature) {
  std::set<std::string> groups, sided_groups, units;
  for (const auto& unit : musculature.units) {
    groups.insert(unit.group);
    units.insert(unit.name);
    if (unit.name.ends_with("_r") || unit.name.ends_with("_l"))
      sided_groups.insert(unit.group + unit.name.substr(unit.name.size() - 2));
  }
  std::vector<std::string> names{"all"};
  for (const auto* some : {&groups, &sided_groups, &units}) names.insert(names.end(), some->begin(), some->end());
  return names;
}

}  // namespace sinew
