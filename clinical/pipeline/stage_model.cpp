#include <algorithm>
#include <cmath>
#include <system_error>

#include "clinical/case/case_io.h"
#include "clinical/case/patient_body.h"
#include "clinical/pipeline/stage_runs.h"
#include "core/file.h"
#include "core/model/physical_scaling.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

constexpr const char* kModelName = "patient";
constexpr const char* kMusculatureFolder = "results/musculature/";
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

FileReference storeModel(const Model& model, const PipelineContext& context) {
  const auto file = context.case_dir / kModelPath;
  saveModel(model, file);
  return {kModelPath, sha256OfFile(file)};
}

/// Later stages read it, so an undone edit must find the file of its day: it is named by its content.
FileReference storeMusculature(const Model& model, const PipelineContext& context) {
  const auto part = context.case_dir / kMusculatureFolder / "part.json";
  saveModel(model, part);
  const std::string hash = sha256OfFile(part);
  const std::string path = kMusculatureFolder + hash.substr(0, 12) + ".json";
  std::filesystem::rename(part, context.case_dir / path);
  return {path, hash};
}

std::string musculatureSummary(const Retargeted& retargeted) {
  const RoutingWeights weights;
  double before = 0, after = 0, farthest_m = 0, worst_deg = 0;
  for (const UnitRouting& unit : retargeted.routing) {
    before += unit.start.total(weights);
    after += unit.end.total(weights);
    farthest_m = std::max(farthest_m, unit.largest_move_m);
  }
  for (const PeakTorqueAngle& peak : retargeted.peak_torque)
    if (std::isfinite(peak.after_deg - peak.reference_deg))
      worst_deg = std::max(worst_deg, std::abs(peak.after_deg - peak.reference_deg));
  return std::to_string(retargeted.routing.size()) + " units retargeted, energy " + rounded(before, 1) + " -> " +
         rounded(after, 1) + ", points moved up to " + rounded(1000 * farthest_m, 0) +
         " mm, angles of peak torque within " + rounded(worst_deg, 1) + " deg";
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

StageRun runMusculature(Case& c, const PipelineContext& context, const Job& job) {
  StageRun run;
  const auto reference = context.retargeting ? context.retargeting() : loadRetargetReference(context.resource_dir);
  const Skeleton& standard = context.reference->skeleton;
  const RetargetOptions options{.physics = patientPhysics(c.patient, c.exam, c.skeleton->shape, standard)};
  Retargeted retargeted = retarget(*reference, c.skeleton->shape, options, job);
  run.outcome = retargeted.outcome;
  if (run.outcome != Outcome::Converged) return run;
  retargeted.model.name = kModelName;
  run.warnings = validateModel(retargeted.model);
  addWarnings(run.warnings, patientPhysicsDoubts(c.patient, c.skeleton->shape, standard));
  c.musculature = storeMusculature(retargeted.model, context);
  const bool examined = c.exam_fit && stateOf(c, Stage::Exam) == StageState::Done;
  c.model = storeModel(examined ? withLengthFactors(retargeted.model, c.exam_fit->length_factors) : retargeted.model,
                       context);
  run.summary = musculatureSummary(retargeted) + ", model " + c.model->sha256.substr(0, 12);
  return run;
}

StageRun runExam(Case& c, const PipelineContext& context, const Job& job) {
  StageRun run;
  const auto protocol = loadExamProtocol(context.resource_dir);
  if (std::ranges::none_of(c.exam.entries, [](const auto& e) { return e.measured_deg.has_value(); }))
    run.warnings.push_back({"nothing_measured", "no test was measured: muscle lengths follow the bones alone"});
  if (!c.patient.mass_kg)
    run.warnings.push_back({"mass_unknown", "body mass is not known: the examiner's torque is that for 75 kg"});
  const Model model = modelBeforeExam(c, *context.reference, context.case_dir);
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

Model modelBeforeExam(const Case& c, const Model& reference, const std::filesystem::path& case_dir) {
  if (c.musculature && stateOf(c, Stage::Musculature) == StageState::Done)
    return loadModel(checkedFile(*c.musculature, case_dir), reference);
  Model model = withPhysics(deformedModel(reference, c.skeleton->shape), reference,
                            patientPhysics(c.patient, c.exam, c.skeleton->shape, reference.skeleton));
  model.name = kModelName;
  return model;
}

std::optional<Model> patientModel(const Case& c, const Model& reference, const std::filesystem::path& case_dir) {
  if (!c.skeleton) return std::nullopt;
  Model model = modelBeforeExam(c, reference, case_dir);
  if (c.exam_fit && stateOf(c, Stage::Exam) == StageState::Done)
    model = withLengthFactors(model, c.exam_fit->length_factors);
  return model;
}

}  // namespace sinew
