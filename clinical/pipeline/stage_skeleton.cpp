#include <algorithm>

#include "clinical/pipeline/stage_inputs_json.h"
#include "clinical/pipeline/stage_table.h"
#include "clinical/pipeline/stage_words.h"
#include "imaging/rig/biplanar_rig_json.h"

namespace sinew {
namespace {

constexpr const char* kResources[] = {"clinical/shape_priors.json", "rom/average-adult.json",
                                      "skeleton/landmarks.csv", "skeleton/reference_skeleton.json"};

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

std::vector<LandmarkObservation> observationsOf(const std::vector<Sighting>& sightings) {
  std::vector<LandmarkObservation> list;
  for (const auto& s : sightings) list.push_back({s.name, s.view, s.uv_px, s.sigma_px});
  return list;
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
  const auto observations = observationsOf(c.sightings);
  const auto priors = loadShapePriors(context.resource_dir);
  c.skeleton = fitSkeleton(context.reference->skeleton, c.rig->views, observations, priors, {}, job);
  addWarnings(run.warnings, c.skeleton->warnings);
  run.outcome = c.skeleton->outcome;
  run.summary = summaryOf(*c.skeleton);
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
                                      .revision = 1,
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
