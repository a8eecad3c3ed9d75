#pragma once
#include "clinical/exam/physical_exam.h"
#include "core/strict_json.h"

namespace sinew {

/// "sinew.exam", version 1: what exam files hold and what a case embeds. Degrees, because this is a form.
Json examToJson(const PhysicalExam& exam);
/// Form only; whether the values are possible is checkExam's to say. @throws InputError.
PhysicalExam examFromJson(const JsonReader& json);

/// One row of "groups": what files, cases and `sinew exam --json` say of a factor.
Json groupFactorToJson(const GroupFactor& group);

Json examFitToJson(const ExamFit& fit);
ExamFit examFitFromJson(const JsonReader& json);

/// {"soleus_r": 0.93, ...}, ratios > 0.
Json factorsToJson(const std::map<std::string, double>& factors);
std::map<std::string, double> factorsFromJson(const JsonReader& json);

}  // namespace sinew
