#include <algorithm>
#include <cmath>

#include "clinical/case/case_io.h"
#include "clinical/case/patient_body.h"
#include "clinical/pipeline/patient_model.h"
#include "clinical/pipeline/reference_files.h"
#include "clinical/pipeline/stage_inputs_json.h"
#include "clinical/pipeline/stage_table.h"
#include "clinical/pipeline/stage_words.h"
#include "core/file.h"
#include "core/model/physical_scaling.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "core/skeleton/shape/shape_json.h"

namespace sinew {
namespace {

constexpr const char* kFolder = "results/musculature/";
/// The reference model, and what its poses and motions are sampled from.
constexpr auto kResources = referenceModelAnd("clinical/clinical_tests.json", "skeleton/joint_motions.json");

std::string inputs(const Case& c) {
  return inputText({{"shape", c.skeleton ? shapeToJson(c.skeleton->shape) : Json(nullptr)},
                    {"mass_kg", numberOrNull(c.patient.mass_kg)},
                    {"age_years", numberOrNull(ageYears(c.patient, c.exam))}});
}

bool hasResult(const Case& c) {
  return c.musculature.has_value() && c.model.has_value();
}

/// Later stages read it, so an undone edit must find the file of its day: it is named by its content.
FileReference storeMusculature(const Model& model, const PipelineContext& context) {
  const auto part = resultFile(kFolder + std::string{"part.json"}, context.case_dir);
  saveModel(model, part);
  const std::string hash = sha256OfFile(part);
  const std::string path = kFolder + hash.substr(0, 12) + ".json";
  std::filesystem::rename(part, context.case_dir / path);
  return {path, hash};
}

std::string summaryOf(const Retargeted& retargeted) {
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

/// The model of the fitted shape, in results/model.json; with the exam's lengths where the exam still holds.
StageRun run(Case& c, const PipelineContext& context, const Job& job) {
  StageRun run;
  const auto reference = context.retargeting ? context.retargeting() : loadRetargetReference(context.resource_dir);
  const Skeleton& standard = context.reference->skeleton;
  const RetargetOptions options{.physics = patientPhysics(c.patient, c.exam, c.skeleton->shape, standard)};
  Retargeted retargeted = retarget(*reference, c.skeleton->shape, options, job);
  run.outcome = retargeted.outcome;
  if (run.outcome != Outcome::Converged) return run;
  retargeted.model.name = kPatientModelName;
  run.warnings = validateModel(retargeted.model);
  addWarnings(run.warnings, patientPhysicsDoubts(c.patient, c.skeleton->shape, standard));
  c.musculature = storeMusculature(retargeted.model, context);
  const bool examined = resultIsOfToday(c, Stage::Exam, context.resource_dir);
  c.model = storeModel(examined ? withLengthFactors(retargeted.model, c.exam_fit->length_factors) : retargeted.model,
                       context.case_dir);
  run.summary = summaryOf(retargeted) + ", model " + c.model->sha256.substr(0, 12);
  return run;
}

std::vector<FileReference> files(const Case& c) {
  std::vector<FileReference> files;
  if (c.musculature) files.push_back(*c.musculature);
  if (c.model && !c.exam_fit) files.push_back(*c.model);  // after the exam it is the exam's
  return files;
}

void copyResult(Case& to, const Case& from) {
  to.musculature = from.musculature;
  to.model = from.model;
}

std::string entered(const Case&) {
  return "Not built";
}

std::string resultLine(const Case& c) {
  return c.model ? "Model built" : "";
}

}  // namespace

constinit const StageRow kMusculatureRow{
    .stage = Stage::Musculature,
    .name = "musculature",
    .title = "Musculature",
    .revision = 3,  // 2: retargeted instead of anchored to the nearest bone; 3: the patient's own mass
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
