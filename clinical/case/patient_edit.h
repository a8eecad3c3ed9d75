#pragma once
#include <string>

#include "clinical/case/case.h"
#include "core/date.h"

namespace sinew {

// What may be stated of a patient, wherever it is entered.

inline constexpr double kMinHeight_m = 0.3, kMaxHeight_m = 2.7;
inline constexpr double kMinMass_kg = 1, kMaxMass_kg = 400;

/// Takes over what a person stated: dates become ISO text. @throws InputError, and nothing changes: a height, mass or
/// sex that cannot be, a date that is no day, a birth in the future or after the examination.
void setPatient(Case& c, Patient patient, const Date& today);

/// @throws InputError as setPatient(): no day, in the future, or before the birth.
void setExamDate(Case& c, const std::string& date, const Date& today);

/// What about the patient is possible and yet unlikely: dates out of order (of a case made by another program), a
/// body mass index that points to a wrong unit. `imaging_date`: as the image says, may be empty.
Warnings patientDoubts(const Case& c, const std::string& imaging_date);

}  // namespace sinew
