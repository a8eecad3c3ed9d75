#include "core/muscle/unit_selection.h"

#include <algorithm>

#include "core/error.h"
#include "core/skeleton/skeleton.h"
#include "core/text.h"

namespace sinew {

std::vector<int> unitsNamed(const Musculature& musculature, const std::string& name) {
  const std::string_view base = withoutSide(name);
  const bool sided = base.size() < name.size();
  // From the narrowest meaning to the widest; the first that names anything holds.
  const auto matches = [&](const MusculotendonUnit& unit, int meaning) {
    const std::string_view unit_base = withoutSide(unit.name);
    if (meaning == 0) return unit_base == base;
    if (meaning == 1) return unit.group == base;
    if (meaning == 2) return unit_base.starts_with(std::string{base} + "_");
    return base == "all";
  };
  std::vector<int> units;
  for (int meaning = 0; meaning < 4 && units.empty(); ++meaning)
    for (std::size_t i = 0; i < musculature.units.size(); ++i) {
      const auto& unit = musculature.units[i];
      if (matches(unit, meaning) && (!sided || sideSign(unit.name) == sideSign(name))) units.push_back(int(i));
    }
  if (!units.empty()) return units;
  std::vector<std::string> known = {"all"};
  for (const auto& unit : musculature.units) {
    known.push_back(unit.name);
    if (std::ranges::find(known, unit.group) == known.end()) known.push_back(unit.group);
  }
  throw InputError{{"muscles", "", "a unit, muscle or group", "'" + name + "'" + didYouMean(name, known)}};
}

std::vector<double> factorsByUnit(const Musculature& musculature, const std::map<std::string, double>& factors,
                                  double without) {
  std::vector<std::pair<std::vector<int>, double>> said;
  for (const auto& [name, factor] : factors) said.emplace_back(unitsNamed(musculature, name), factor);
  std::ranges::stable_sort(said, std::ranges::greater{}, [](const auto& entry) { return entry.first.size(); });
  std::vector<double> by_unit(musculature.units.size(), without);
  for (const auto& [units, factor] : said)
    for (const int i : units) by_unit[std::size_t(i)] = factor;
  return by_unit;
}

}  // namespace sinew
