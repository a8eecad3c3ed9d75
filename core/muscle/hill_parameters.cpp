#include "core/muscle/hill_parameters.h"

#include <algorithm>

#include "core/error.h"
#include "core/muscle/unit_selection.h"
#include "core/text.h"

namespace sinew {

const std::vector<HillField>& hillFields() {
  static const std::vector<HillField> fields = {{"active_width", &HillParameters::active_width, 0.05, 5},
                                                {"passive_strain", &HillParameters::passive_strain, 0.1, 3},
                                                {"passive_shape", &HillParameters::passive_shape, 0.5, 20},
                                                {"tendon_strain", &HillParameters::tendon_strain, 0.005, 0.3},
                                                {"max_velocity_1_s", &HillParameters::max_velocity_1_s, 0.5, 50},
                                                {"max_lengthening", &HillParameters::max_lengthening, 1.05, 3}};
  return fields;
}

const HillField& hillField(const std::string& name, const std::string& where) {
  const auto found = std::ranges::find(hillFields(), name, &HillField::name);
  if (found != hillFields().end()) return *found;
  std::vector<std::string> known;
  for (const auto& field : hillFields()) known.push_back(field.name);
  throw InputError{{where, "curve", "a known parameter", "'" + name + "'" + didYouMean(name, known)}};
}

Musculature withCurves(Musculature musculature, std::span<const CurveEdit> edits) {
  for (const CurveEdit& edit : edits) {
    const HillField& field = hillField(edit.field, edit.units);
    if (!(edit.value >= field.low && edit.value <= field.high)) {
      throw InputError{
          {edit.units, edit.field, "a number " + brief(field.low) + " ... " + brief(field.high), brief(edit.value)}};
    }
    for (const int i : unitsNamed(musculature, edit.units))
      musculature.units[std::size_t(i)].curves.*field.value = edit.value;
  }
  return musculature;
}

}  // namespace sinew
