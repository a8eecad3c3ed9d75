#pragma once
#include <QString>

#include "clinical/case/case.h"
#include "core/rom/tests/clinical_tests.h"

namespace sinew {

// What the page of the examination says, as text.

/// "norm 33° ± 11° (not verified)", of the patient's age and sex.
QString normWords(const ClinicalTest& test, const TestNorm& norm);

/// Norm of the patient's age and sex, in the signs of the coordinates.
TestNorm patientNorm(const Case& c, const ClinicalTest& test);

/// Every solved group with factor, 95 % interval and fibre-only factor, as a table in rich text; a sentence before
/// anything was solved.
QString factorTable(const Case& c, const ClinicalTests& tests);

}  // namespace sinew
