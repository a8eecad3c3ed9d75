#include "app/cli/support/patient_options.h"

#include <cctype>

#include "core/text.h"

namespace sinew {
namespace {

constexpr const char* kUnknown = "unknown";

void applyNumber(const std::string& text, const char* option, std::optional<double>& value) {
  if (text.empty()) return;
  if (text == kUnknown)
    value.reset();
  else
    value = parseNumber(text, "patient", option);
}

}  // namespace

void PatientOptions::addTo(CLI::App& command) {
  command.add_option("--sex", sex, "F, M or O");
  command.add_option("--birth-date", birth_date, "YYYY-MM-DD");
  command.add_option("--height-m,--height", height_m, "height of the patient in metres");
  command.add_option("--mass-kg,--mass", mass_kg, "mass of the patient in kilograms");
  command.add_option("--diagnosis", diagnosis, "in words");
}

void PatientOptions::applyTo(Patient& patient) const {
  if (sex == kUnknown)
    patient.sex.clear();
  else if (!sex.empty())
    patient.sex = sex.size() == 1 ? std::string(1, char(std::toupper(static_cast<unsigned char>(sex[0])))) : sex;
  if (!birth_date.empty()) patient.birth_date = birth_date == kUnknown ? "" : birth_date;
  applyNumber(height_m, "--height-m", patient.height_m);
  applyNumber(mass_kg, "--mass-kg", patient.mass_kg);
  if (diagnosis) patient.diagnosis = *diagnosis;
}

}  // namespace sinew
