#include "clinical/case/patient_edit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace sinew {
namespace {

/// A child of low weight has 11, the heaviest adults 60: what lies beyond is a wrong figure or a wrong unit.
constexpr double kMinBodyMassIndex = 8, kMaxBodyMassIndex = 70;

std::string plain(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void expectRange(const std::optional<double>& value, double low, double high, const char* field) {
  if (value && !(*value >= low && *value <= high))
    throw InputError{{"patient", field, plain(low) + " to " + plain(high), plain(*value)}};
}

void expectOrder(const std::string& birth_date, const std::string& exam_date, const char* field) {
  const auto born = dateFromText(birth_date), examined = dateFromText(exam_date);
  if (born && examined && certainlyBefore(*examined, *born))
    throw InputError{{"patient", field, "a birth before the examination", birth_date + " and " + exam_date}};
}

void expectPast(const std::string& date, const Date& today, const char* field) {
  const auto day = dateFromText(date);
  if (day && certainlyBefore(today, *day)) throw InputError{{"patient", field, "no day in the future", date}};
}

}  // namespace

void setPatient(Case& c, Patient patient, const Date& today) {
  constexpr std::array kSexes = {"F", "M", "O", ""};
  if (std::ranges::find(kSexes, patient.sex) == kSexes.end())
    throw InputError{{"patient", "sex", "F, M, O or nothing", "'" + patient.sex + "'"}};
  expectRange(patient.height_m, kMinHeight_m, kMaxHeight_m, "height [m]");
  expectRange(patient.mass_kg, kMinMass_kg, kMaxMass_kg, "mass [kg]");
  patient.birth_date = checkedDate(patient.birth_date, "patient", "birth date");
  expectPast(patient.birth_date, today, "birth date");
  expectOrder(patient.birth_date, c.exam.date, "birth date");
  c.patient = std::move(patient);
}

void setExamDate(Case& c, const std::string& date, const Date& today) {
  const std::string checked = checkedDate(date, "examination", "date");
  expectPast(checked, today, "date of the examination");
  expectOrder(c.patient.birth_date, checked, "date of the examination");
  c.exam.date = checked;
}

Warnings patientDoubts(const Case& c, const std::string& imaging_date) {
  Warnings doubts;
  const auto born = dateFromText(c.patient.birth_date);
  const auto doubt = [&](const std::string& date, const char* code, const char* what) {
    const auto day = dateFromText(date);
    if (born && day && certainlyBefore(*day, *born))
      doubts.push_back(
          {code, std::string{what} + " before the patient's birth: one of the dates is wrong, no age is given"});
  };
  doubt(imaging_date, "imaged_before_birth", "the radiographs were taken");
  doubt(c.exam.date, "examined_before_birth", "the examination was made");
  if (c.patient.height_m && c.patient.mass_kg) {
    const double index = *c.patient.mass_kg / (*c.patient.height_m * *c.patient.height_m);
    if (index < kMinBodyMassIndex || index > kMaxBodyMassIndex)
      doubts.push_back({"body_mass_index", "height " + plain(*c.patient.height_m) + " m and mass " +
                                               plain(*c.patient.mass_kg) + " kg do not fit each other"});
  }
  return doubts;
}

}  // namespace sinew
