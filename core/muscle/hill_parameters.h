#pragma once
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// What a person may edit in the curves of one unit; the default values are those of Thelen 2003, young adults.
struct HillParameters {
  double active_width = 0.45;    ///< gamma of exp(-(l - 1)^2 / gamma)
  double passive_strain = 0.6;   ///< fibre strain at which the passive force is F_max
  double passive_shape = 5;      ///< k_PE: how late the passive force sets in
  double tendon_strain = 0.033;  ///< tendon strain at which its force is F_max
  double max_velocity_1_s = 10;  ///< fastest shortening at full activation, optimal fibre lengths per second
  double max_lengthening = 1.4;  ///< force of the fastest lengthening over the isometric one
  friend bool operator==(const HillParameters&, const HillParameters&) = default;
};

/// One of them by its name in files and options, and what it may be.
struct HillField {
  std::string name;
  double HillParameters::*value;
  double low, high;
};
const std::vector<HillField>& hillFields();
/// @throws InputError with the nearest names.
const HillField& hillField(const std::string& name, const std::string& where);

struct Musculature;

/// "soleus", "active_width", 0.5: one figure of the curves of the units that a name means (unitsNamed()).
struct CurveEdit {
  std::string units, field;
  double value;
};
/// The edits in their order. @throws InputError: unknown units or field, a value outside its range.
Musculature withCurves(Musculature musculature, std::span<const CurveEdit> edits);

}  // namespace sinew
