#include <algorithm>
#include <cmath>
#include <system_error>

#include "clinical/case_io.h"
#include "clinical/stage_runs.h"
#include "core/file.h"

namespace sinew {
namespace {

constexpr const char* kModelPath = "results/model.json";
constexpr const char* kReportPath = "results/report.pdf";
constexpr double kReferenceMass_kg = 75;

std::vector<LandmarkObservation> observationsOf(const std::vector<Sighting>& sightings) {
  std::vector<LandmarkObservation> list;
  for (const auto& s : sightings) list.push_back({s.name, s.view, s.uv_px, s.sigma_px});
  return list;
}

std::string skeletonSummary(const SkeletonFit& fit) {
  std::string text = "RMS " + rounded(fit.rms_px, 2) + " px";
  for (const auto& figure : fit.figures)
    if (figure.quantity == "femur_length" || figure.quantity == "tibia_length")
      text += ", " + figure.quantity.substr(0, 5) + " " + figure.side + " " + rounded(figure.value, 1) + " mm";
  if (!fit.undetermined.empty()) text += ", " + std::to_string(fit.undetermined.size()) + " parameters undetermined";
  return text;
}

/// The model of the fitted bones, before the examination.
Model fittedModel(const Case& c, const Model& reference) {
  Model model = deformedModel(reference, c.skeleton->shape);
  model.name = "patient";
  return model;
}

FileReference storeModel(const Model& model, const PipelineContext& context) {
  const auto file = context.case_dir / kModelPath;
  saveModel(model, file);
  return {kModelPath, sha256OfFile(file)};
}

std::string examSummary(const ExamFit& fit) {
  int measured = 0;
  const ExamComparison* worst = nullptr;
  for (const auto& test : fit.tests) {
    measured += test.measured_deg.has_value();
    if (std::isfinite(test.residual_deg) && (!worst || std::abs(test.residual_deg) > std::abs(worst->residual_deg)))
      worst = &test;
  }
  std::string text =
      std::to_string(measured) + " tests measured, " + std::to_string(fit.length_factors.size()) + " units changed";
  if (worst)
    text +=
        ", largest residual " + rounded(worst->residual_deg, 1) + " deg (" + worst->test + " " + worst->side + ")";
  return text;
}

}  // namespace

StageRun runSkeleton(Case& c, const PipelineContext& context, const Job& job) {
  StageRun run;
  if (!c.rig->patient_aligned)
    run.warnings.push_back({"not_patient_aligned", "the world frame of the geometry is not the patient's"});
  const auto observations = observationsOf(c.sightings);
  const auto priors = loadShapePriors(context.resource_dir);
  c.skeleton = fitSkeleton(context.reference->skeleton, c.rig->views, observations, priors, {}, job);
  addWarnings(run.warnings, c.skeleton->warnings);
  run.outcome = c.skeleton->outcome;
  run.summary = skeletonSummary(*c.skeleton);
  return run;
}

StageRun runMusculature(Case& c, const PipelineContext& context) {
  StageRun run;
  const auto model = patientModel(c, *context.reference);
  run.warnings = validateModel(*model);
  c.model = storeModel(*model, context);
  run.summary = std::to_string(model->musculature.units.size()) + " units, model " + c.model->sha256.substr(0, 12);
  return run;
}

StageRun runExam(Case& c, const PipelineContext& context, const Job& job) {
  StageRun run;
  const auto protocol = loadExamProtocol(context.resource_dir);
  if (std::ranges::none_of(c.exam.entries, [](const auto& e) { return e.measured_deg.has_value(); }))
    run.warnings.push_back({"nothing_measured", "no test was measured: muscle lengths follow the bones alone"});
  if (!c.patient.mass_kg)
    run.warnings.push_back({"mass_unknown", "body mass is not known: the examiner's torque is that for 75 kg"});
  const Model model = fittedModel(c, *context.reference);
  c.exam_fit = applyExam(model, c.exam, protocol, c.patient.mass_kg.value_or(kReferenceMass_kg), job);
  addWarnings(run.warnings, c.exam_fit->warnings);
  run.outcome = c.exam_fit->outcome;
  run.summary = examSummary(*c.exam_fit);
  if (run.outcome == Outcome::Converged)
    c.model = storeModel(withLengthFactors(model, c.exam_fit->length_factors), context);
  return run;
}

StageRun runReport(Case& c, const PipelineContext& context) {
  const auto reasons = reasonsAgainstReport(c);
  if (!reasons.empty()) {
    std::string all;
    for (const auto& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
    throw InputError{{"report", "", "every stage done", all}};
  }
  if (!context.write_report) throw InputError{{"report", "", "a program that can draw", "one that cannot"}};
  const auto file = context.case_dir / kReportPath;
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
  c.report = {kReportPath, sha256OfFile(file)};
  return {.outcome = Outcome::Converged,
          .warnings = {},
          .summary = std::to_string((std::filesystem::file_size(file) + 1023) / 1024) + " kB"};
}

std::optional<Model> patientModel(const Case& c, const Model& reference) {
  if (!c.skeleton) return std::nullopt;
  Model model = fittedModel(c, reference);
  if (c.exam_fit && stateOf(c, Stage::Exam) == StageState::Done)
    model = withLengthFactors(model, c.exam_fit->length_factors);
  return model;
}

}  // namespace sinew
