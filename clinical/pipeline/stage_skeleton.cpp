#include <algorithm>

#include "clinical/pipeline/patient_fit.h"
#include "clinical/pipeline/side_check.h"
#include "clinical/pipeline/stage_inputs_json.h"
#include "clinical/pipeline/stage_table.h"
#include "clinical/pipeline/stage_words.h"
#include "imaging/rig/biplanar_rig_json.h"

namespace sinew {
namespace {

constexpr const char* kResources[] = {"clinical/landmark_protocol.json", "clinical/shape_priors.json",
                                      "rom/average-adult.json", "skeleton/landmarks.csv",
                                      "skeleton/reference_skeleton.json"};

std::string inputs(const Case& c) {
  return inputText({{"rig", orNull(c.rig, rigToJson)}, {"sightings", sightingInputs(c.sightings)}});
}

bool hasResult(const Case& c) {
  return c.skeleton.has_value();
}

/// Points that are no landmarks of the skeleton fit nothing; whether they are is known once the landmarks are done.
std::string missing(const Case& c, StageState landmarks) {
  const auto record = c.stages.find(Stage::Landmarks);
  const bool foreign =
      landmarks == StageState::Done && record != c.stages.end() &&
      std::ranges::any_of(record->second.warnings, [](const Warning& w) { return w.code == kNoKnownLandmarks; });
  return foreign ? "no known landmark of the skeleton has been picked" : "";
}

std::string summaryOf(const SkeletonFit& fit) {
  std::string text = "RMS " + rounded(fit.rms_px, 2) + " px";
  for (const auto& figure : fit.figures)
    if (figure.quantity == "femur_length" || figure.quantity == "tibia_length")
      text += ", " + figure.quantity.substr(0, 5) + " " + figure.side + " " + rounded(figure.value, 1) + " mm";
  if (!fit.undetermined.empty()) text += ", " + std::to_string(fit.undetermined.size()) + " parameters undetermined";
  return text;
}

/// Shape and posture from the sightings.
StageRun run(Case& c, const PipelineContext& context, const Job& job) {
  StageRun run;
  if (!c.rig->patient_aligned)
    run.warnings.push_back({"not_patient_aligned", "the world frame of the geometry is not the patient's"});
  c.skeleton = fitPatient(context.reference->skeleton, *c.rig, c.sightings, context.resource_dir, job);
  addWarnings(run.warnings, c.skeleton->warnings);
  run.outcome = c.skeleton->outcome;
  run.summary = summaryOf(*c.skeleton);
  if (run.outcome == Outcome::Converged && disagreeGrossly(*c.skeleton, c.exchanged_sides)) {
    run.outcome = Outcome::NotConverged;
    run.summary = "the picks disagree grossly: no figure is to be used";
    if (!c.exchanged_sides.empty()) run.summary += "; left and right are exchanged, see the landmarks";
  }
  return run;
}

void copyResult(Case& to, const Case& from) {
  to.skeleton = from.skeleton;
}

std::string entered(const Case&) {
  return "Not fitted";
}

std::string resultLine(const Case& c) {
  return c.skeleton ? "Fitted, RMS " + rounded(c.skeleton->rms_px, 2) + " px" : "";
}

}  // namespace

constinit const StageRow kSkeletonRow{.stage = Stage::Skeleton,
                                      .name = "skeleton",
                                      .title = "Skeleton",
                                      .revision = 2,
                                      .resources = kResources,
                                      .inputs = inputs,
                                      .has_result = hasResult,
                                      .missing = missing,
                                      .run = run,
                                      .copy_result = copyResult,
                                      .to_enter = "Place landmarks that the skeleton knows.",
                                      .entered = entered,
                                      .result_line = resultLine};

}  // namespace sinew
