#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "clinical/case/case.h"

namespace sinew {

/// Options that state the patient: of `new` and of `patient`. Empty = not given; "unknown" takes back.
struct PatientOptions {
  std::string sex, birth_date, height_m, mass_kg;
  std::optional<std::string> diagnosis;

  void addTo(CLI::App& command);
  /// @throws InputError naming the option if it is no number or no sex; what setPatient() checks is left to it.
  void applyTo(Patient& patient) const;
};

}  // namespace sinew
