#include <algorithm>
#include <cmath>

#include "clinical/case/patient_body.h"
#include "clinical/exam/physical_exam_json.h"
#include "clinical/pipeline/patient_model.h"
#include "clinical/pipeline/reference_files.h"
#include "clinical/pipeline/stage_inputs_json.h"
#include "clinical/pipeline/stage_table.h"
#include "clinical/pipeline/stage_words.h"
#include "core/passive/structures.h"

namespace sinew {
namespace {

/// The protocol; and what the stored musculature leaves to the reference when it is read.
constexpr auto kResources = referenceModelAnd("clinical/clinical_tests.json");

std::string inputs(const Case& c) {
  return inputText({{"musculature", fileInput(c.musculature)},
                    {"exam", examToJson(c.exam)},
                    {"mass_kg", numberOrNull(c.patient.mass_kg)},
                    {"birth_date", c.patient.birth_date},
                    {"sex", c.patient.sex}});
}

bool hasResult(const Case& c) {
  return c.exam_fit.has_value();
}

std::size_t measuredTests(const ExamFit& fit) {
  return std::size_t(std::ranges::count_if(fit.tests, [](const auto& t) { return t.measured_deg.has_value(); }));
}

std::string summaryOf(const ExamFit& fit) {
  const ExamComparison* worst = nullptr;
  for (const auto& test : fit.tests)
    if (std::isfinite(test.residual_deg) && (!worst || std::abs(test.residual_deg) > std::abs(worst->residual_deg)))
      worst = &test;
  std::string text = std::to_string(measuredTests(fit)) + " tests measured, " +
                     std::to_string(fit.length_factors.size()) + " units changed";
  if (worst)
    text +=
        ", largest residual " + rounded(worst->residual_deg, 1) + " deg (" + worst->test + " " + worst->side + ")";
  return text;
}

/// Muscle lengths that make the simulated tests meet the measured ones; the model with them.
StageRun run(Case& c, const PipelineContext& context, const Job& job) {
  StageRun run;
  const auto protocol = loadClinicalTests(context.resource_dir);
  if (std::ranges::none_of(c.exam.entries, [](const auto& e) { return e.measured_deg.has_value(); }))
    run.warnings.push_back({"nothing_measured", "no test was measured: muscle lengths follow the bones alone"});
  const Model model = modelBeforeExam(c, *context.reference, context.case_dir, context.resource_dir);
  const ExamSubject subject{c.patient.mass_kg.value_or(bodyMass_kg(model.skeleton)), ageYears(c.patient, c.exam),
                            c.patient.sex};
  if (!c.patient.mass_kg)
    run.warnings.push_back({"mass_unknown", "body mass is not known: the examiner's torque is that for the " +
                                                rounded(subject.mass_kg, 0) + " kg that belong to the bones"});
  c.exam_fit = applyExam(model, c.exam, protocol, subject, job);
  addWarnings(run.warnings, c.exam_fit->warnings);
  run.outcome = c.exam_fit->outcome;
  run.summary = summaryOf(*c.exam_fit);
  if (run.outcome == Outcome::Converged)
    c.model = storeModel(withLengthFactors(model, c.exam_fit->length_factors), context.case_dir);
  return run;
}

std::vector<FileReference> files(const Case& c) {
  return c.model ? std::vector{*c.model} : std::vector<FileReference>{};
}

void copyResult(Case& to, const Case& from) {
  to.exam_fit = from.exam_fit;
  to.model = from.model;
}

std::string entered(const Case& c) {
  const auto measured =
      std::ranges::count_if(c.exam.entries, [](const auto& e) { return e.measured_deg.has_value(); });
  return measured ? counted(std::size_t(measured), "angle measured", "angles measured") : "Nothing measured";
}

std::string resultLine(const Case& c) {
  if (!c.exam_fit) return {};
  return counted(measuredTests(*c.exam_fit), "angle", "angles") + ", " +
         counted(c.exam_fit->length_factors.size(), "muscle", "muscles");
}

}  // namespace

constinit const StageRow kExamRow{
    .stage = Stage::Exam,
    .name = "exam",
    .title = "Examination",
    .revision = 5,  // 2: on the retargeted musculature; 3: on the very file of it; 4: the patient's own mass and
                    // joints; 5: capsules and ligaments in the tests, norms of the age, intervals
    .resources = kResources,
    .inputs = inputs,
    .has_result = hasResult,
    .run = run,
    .files = files,
    .copy_result = copyResult,
    .to_enter = "Enter at least one measured angle.",
    .entered = entered,
    .result_line = resultLine};

}  // namespace sinew
