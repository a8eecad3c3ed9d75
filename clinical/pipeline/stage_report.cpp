#include <system_error>

#include "clinical/case/case_io.h"
#include "clinical/case/case_results_json.h"
#include "clinical/exam/physical_exam_json.h"
#include "clinical/pipeline/reference_files.h"
#include "clinical/pipeline/stage_inputs_json.h"
#include "clinical/pipeline/stage_table.h"
#include "core/file.h"
#include "imaging/rig/biplanar_rig_json.h"

namespace sinew {
namespace {

constexpr const char* kPath = "results/report.pdf";
constexpr auto kResources = referenceModelAnd("clinical/clinical_tests.json", "clinical/norms.json");

/// A result without what differs from run to run.
Json examFitWithoutTimes(ExamFit fit) {
  fit.seconds = 0;
  return examFitToJson(fit);
}

/// Warnings and outcome of every stage before it: the report prints them.
Json recordsOf(const Case& c) {
  Json json = Json::object();
  for (const auto& [stage, record] : c.stages)
    if (stage < Stage::Report)
      json[nameOf(stage)] = Json::array({nameOf(record.outcome), record.input_hash, warningsToJson(record.warnings)});
  return json;
}

std::string inputs(const Case& c) {
  return inputText({{"patient", sha256(c.patient.id + '\n' + c.patient.name + '\n' + c.patient.sex + '\n' +
                                       c.patient.birth_date + '\n' + c.patient.diagnosis)},
                    {"height_m", numberOrNull(c.patient.height_m)},
                    {"mass_kg", numberOrNull(c.patient.mass_kg)},
                    {"images", imageInputs(c.images)},
                    {"rig", orNull(c.rig, rigToJson)},
                    {"landmarks", orNull(c.landmarks, triangulationToJson)},
                    {"skeleton", orNull(c.skeleton, skeletonFitToJson)},
                    {"model", fileInput(c.model)},
                    {"exam", examToJson(c.exam)},
                    {"exam_fit", orNull(c.exam_fit, examFitWithoutTimes)},
                    {"truth", orNull(c.truth, truthToJson)},
                    {"stages", recordsOf(c)}});
}

bool hasResult(const Case& c) {
  return c.report.has_value();
}

/// results/report.pdf, whole or as it was.
StageRun run(Case& c, const PipelineContext& context, const Job&) {
  if (!context.write_report) throw InputError{{"report", "", "a program that can draw", "one that cannot"}};
  const auto file = resultFile(kPath, context.case_dir);
  const auto part = context.case_dir / "results" / ".report.part.pdf";
  std::error_code ignored;
  try {
    std::filesystem::create_directories(part.parent_path(), ignored);
    context.write_report(c, context.case_dir, part);
    writeFileAtomically(file, readFile(part));
    std::filesystem::remove(part, ignored);
  } catch (...) {
    std::filesystem::remove(part, ignored);
    throw;
  }
  c.report = {kPath, sha256OfFile(file)};
  return {.outcome = Outcome::Converged,
          .warnings = {},
          .summary = std::to_string((std::filesystem::file_size(file) + 1023) / 1024) + " kB"};
}

std::vector<FileReference> files(const Case& c) {
  return c.report ? std::vector{*c.report} : std::vector<FileReference>{};
}

void copyResult(Case& to, const Case& from) {
  to.report = from.report;
}

std::string entered(const Case&) {
  return "Not made";
}

std::string resultLine(const Case& c) {
  return c.report ? "Report written" : "";
}

}  // namespace

constinit const StageRow kReportRow{.stage = Stage::Report,
                                    .name = "report",
                                    .title = "Report",
                                    .revision = 1,
                                    .resources = kResources,
                                    .inputs = inputs,
                                    .has_result = hasResult,
                                    .run = run,
                                    .files = files,
                                    .copy_result = copyResult,
                                    .to_enter = "Nothing is entered here.",
                                    .entered = entered,
                                    .result_line = resultLine};

}  // namespace sinew
