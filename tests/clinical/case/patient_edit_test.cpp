#include "clinical/case/patient_edit.h"

#include <gmock/gmock.h>

#include "clinical/case/case_io.h"

namespace sinew {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr Date kToday{2026, 6, 1};

std::string complaint(Patient patient, const std::string& exam_date = "") {
  Case c;
  c.exam.date = exam_date;
  const Case before = c;
  try {
    setPatient(c, std::move(patient), kToday);
  } catch (const InputError& error) {
    EXPECT_TRUE(c == before);  // refused as a whole
    return error.what();
  }
  return "";
}

TEST(PatientEdit, WhatCanBeIsTakenOver) {
  Case c;
  setPatient(c, {.sex = "F", .birth_date = "20140309", .height_m = 1.28, .mass_kg = 23.5}, kToday);
  EXPECT_EQ(c.patient.birth_date, "2014-03-09");
  EXPECT_EQ(c.patient.mass_kg, 23.5);
  EXPECT_TRUE(caseFromJson(caseToJson(c), "case") == c);
  setPatient(c, {.birth_date = "2026-06-01"}, kToday);  // born today; all else taken back
  EXPECT_FALSE(c.patient.mass_kg);
}

TEST(PatientEdit, WhatCannotBeIsRefusedByName) {
  EXPECT_THAT(complaint({.birth_date = "2014-02-31"}), HasSubstr("birth date"));
  EXPECT_THAT(complaint({.birth_date = "2026-06-02"}), HasSubstr("no day in the future"));
  EXPECT_THAT(complaint({.birth_date = "2020-01-01"}, "2019-05-05"), HasSubstr("before the examination"));
  EXPECT_THAT(complaint({.height_m = 164}), HasSubstr("height [m]: expected 0.3 to 2.7, found 164"));
  EXPECT_THAT(complaint({.mass_kg = 0}), HasSubstr("mass [kg]"));
  EXPECT_THAT(complaint({.mass_kg = std::nan("")}), HasSubstr("mass [kg]"));
  EXPECT_THAT(complaint({.sex = "female"}), HasSubstr("sex"));
}

TEST(PatientEdit, TheDateOfTheExaminationIsADayBetweenBirthAndToday) {
  Case c;
  setPatient(c, {.birth_date = "2014-03-09"}, kToday);
  setExamDate(c, "20260105", kToday);
  EXPECT_EQ(c.exam.date, "2026-01-05");
  for (const char* wrong : {"2014-03-08", "2026-06-02", "2026-02-30", "yesterday"}) {
    EXPECT_THROW(setExamDate(c, wrong, kToday), InputError) << wrong;
    EXPECT_EQ(c.exam.date, "2026-01-05");
  }
  setExamDate(c, "", kToday);
  EXPECT_EQ(c.exam.date, "");
}

TEST(PatientEdit, DatesOutOfOrderAndWrongUnitsAreDoubted) {
  Case c;
  c.patient.birth_date = "2020-01-01";
  c.exam.date = "2019-01-01";
  EXPECT_THAT(patientDoubts(c, "20180101"), SizeIs(2));
  EXPECT_THAT(patientDoubts(c, ""), SizeIs(1));
  c.exam.date = "2024-01-01";
  EXPECT_THAT(patientDoubts(c, "20240101"), IsEmpty());
  c.patient.height_m = 1.64;
  c.patient.mass_kg = 54;
  EXPECT_THAT(patientDoubts(c, ""), IsEmpty());
  c.patient.mass_kg = 5.4;
  EXPECT_THAT(patientDoubts(c, ""), SizeIs(1));
}

TEST(PatientEdit, AStoredDateThatIsNoDayIsRefused) {
  Case c;
  c.patient.birth_date = "2014-02-31";
  EXPECT_THROW(caseFromJson(caseToJson(c), "case.json"), InputError);
  c.patient.birth_date.clear();
  c.exam.date = "0000-00-00";
  EXPECT_THROW(caseFromJson(caseToJson(c), "case.json"), InputError);
}

}  // namespace
}  // namespace sinew
