#include "clinical/case/patient_body.h"

#include <cstdio>

#include "clinical/case/age.h"
#include "core/model/physical_scaling.h"

namespace sinew {

std::optional<double> ageYears(const Patient& patient, const PhysicalExam& exam) {
  const auto age = ageAt(patient.birth_date, exam.date);
  return age ? std::optional{age->inYears()} : std::nullopt;
}

PhysicsFactors patientPhysics(const Patient& patient, const PhysicalExam& exam, const ShapeParameters& shape,
                              const Skeleton& reference) {
  PhysicsFactors factors;
  if (patient.mass_kg) factors.mass_factors = massFactorsFor(reference, shape, *patient.mass_kg);
  factors.age_years = ageYears(patient, exam);
  return factors;
}

Warnings patientPhysicsDoubts(const Patient& patient, const ShapeParameters& shape, const Skeleton& reference) {
  constexpr double kLean = 0.6, kHeavy = 1.8;  // of the volume that belongs to the bones
  const double volume_kg = volumeMass_kg(reference, shape);
  char text[160];
  if (!patient.mass_kg) {
    std::snprintf(text, sizeof text, "body mass is not known: the model has the %.0f kg that belong to its bones",
                  volume_kg);
    return {{"model_mass_unknown", text}};
  }
  const double ratio = *patient.mass_kg / volume_kg;
  if (ratio > kLean && ratio < kHeavy) return {};
  std::snprintf(text, sizeof text,
                "a mass of %.0f kg was entered, bones of this size belong to a body of about %.0f kg",
                *patient.mass_kg, volume_kg);
  return {{"mass_unlike_bones", text}};
}

}  // namespace sinew
