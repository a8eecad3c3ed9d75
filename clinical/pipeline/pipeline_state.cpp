#include <algorithm>

#include "clinical/case/case_results_json.h"
#include "clinical/case/patient_body.h"
#include "clinical/exam/physical_exam_json.h"
#include "clinical/pipeline/pipeline.h"
#include "core/file.h"
#include "core/skeleton/shape/shape_json.h"
#include "imaging/rig/biplanar_rig_json.h"

namespace sinew {
namespace {

/// To be raised when a stage computes something else from the same inputs: results of the old method become stale.
int methodRevision(Stage stage) {
  switch (stage) {
    case Stage::Images:
    case Stage::Calibration:
    case Stage::Landmarks:
    case Stage::Skeleton:
    case Stage::Report:
      return 1;
    case Stage::Exam:
      return 3;  // 2: on the retargeted musculature; 3: of the patient's own mass, forces and joints
    case Stage::Musculature:
      return 3;  // 2: retargeted instead of anchored to the nearest bone; 3: of the patient's own mass
  }
  return 0;
}

template <class T, class Write>
Json orNull(const std::optional<T>& value, Write write) {
  return value ? write(*value) : Json(nullptr);
}

Json sightingsToJson(const std::vector<Sighting>& sightings) {
  Json list = Json::array();
  for (const auto& s : sightings) list.push_back(Json::array({s.name, s.view, s.uv_px.x(), s.uv_px.y(), s.sigma_px}));
  return list;
}

Json imagesToJson(const std::vector<CaseImage>& images) {
  Json list = Json::array();
  for (const auto& image : images)
    list.push_back(Json::array({image.file.sha256, numberOrNull(image.declared_spacing_mm)}));
  return list;
}

Json phantomHashes(const PhantomImages& phantom) {
  return Json::array({phantom.images[0].sha256, phantom.images[1].sha256, phantom.beads.sha256});
}

/// A result without what differs from run to run.
Json examFitWithoutTimes(ExamFit fit) {
  fit.seconds = 0;
  return examFitToJson(fit);
}

/// Warnings and outcome of every stage before the report: the report prints them.
Json recordsForReport(const Case& c) {
  Json json = Json::object();
  for (const auto& [stage, record] : c.stages)
    if (stage != Stage::Report)
      json[nameOf(stage)] = Json::array({nameOf(record.outcome), record.input_hash, warningsToJson(record.warnings)});
  return json;
}

Json inputsOf(const Case& c, Stage stage) {
  switch (stage) {
    case Stage::Images:
      return {{"images", imagesToJson(c.images)}};
    case Stage::Calibration:
      return {{"images", imagesToJson(c.images)},
              {"phantom", orNull(c.phantom, phantomHashes)},
              {"imported_rig", orNull(c.imported_rig, rigToJson)}};
    case Stage::Landmarks:
    case Stage::Skeleton:
      return {{"rig", orNull(c.rig, rigToJson)}, {"sightings", sightingsToJson(c.sightings)}};
    case Stage::Musculature:
      return {{"shape", c.skeleton ? shapeToJson(c.skeleton->shape) : Json(nullptr)},
              {"mass_kg", numberOrNull(c.patient.mass_kg)},
              {"age_years", numberOrNull(ageYears(c.patient, c.exam))}};
    case Stage::Exam:
      return {{"shape", c.skeleton ? shapeToJson(c.skeleton->shape) : Json(nullptr)},
              {"exam", examToJson(c.exam)},
              {"mass_kg", numberOrNull(c.patient.mass_kg)}};
    case Stage::Report:
      return {{"patient", sha256(c.patient.id + '\n' + c.patient.name + '\n' + c.patient.sex + '\n' +
                                 c.patient.birth_date + '\n' + c.patient.diagnosis)},
              {"height_m", numberOrNull(c.patient.height_m)},
              {"images", imagesToJson(c.images)},
              {"rig", orNull(c.rig, rigToJson)},
              {"landmarks", orNull(c.landmarks, triangulationToJson)},
              {"skeleton", orNull(c.skeleton, skeletonFitToJson)},
              {"model", c.model ? Json(c.model->sha256) : Json(nullptr)},
              {"exam", examToJson(c.exam)},
              {"exam_fit", orNull(c.exam_fit, examFitWithoutTimes)},
              {"truth", orNull(c.truth, truthToJson)},
              {"stages", recordsForReport(c)}};
  }
  return {};
}

std::optional<Stage> stageBefore(Stage stage) {
  const auto it = std::ranges::find(kStages, stage);
  if (it == kStages.begin()) return std::nullopt;
  return *(it - 1);
}

/// Whether a result of the stage is there, from whatever inputs.
bool hasResult(const Case& c, Stage stage) {
  switch (stage) {
    case Stage::Images:
      return c.stages.contains(stage) && c.stages.at(stage).outcome == Outcome::Converged;
    case Stage::Calibration:
      return c.rig.has_value();
    case Stage::Landmarks:
      return c.landmarks.has_value();
    case Stage::Skeleton:
      return c.skeleton.has_value();
    case Stage::Musculature:
      return c.musculature.has_value() && c.model.has_value();
    case Stage::Exam:
      return c.exam_fit.has_value();
    case Stage::Report:
      return c.report.has_value();
  }
  return false;
}

bool hasWarning(const Case& c, Stage stage, std::string_view code) {
  const auto it = c.stages.find(stage);
  return it != c.stages.end() &&
         std::ranges::any_of(it->second.warnings, [&](const Warning& w) { return w.code == code; });
}

}  // namespace

std::string nameOf(StageState state) {
  switch (state) {
    case StageState::Missing:
      return "missing";
    case StageState::Blocked:
      return "blocked";
    case StageState::Ready:
      return "ready";
    case StageState::Stale:
      return "stale";
    case StageState::Done:
      return "done";
    case StageState::Failed:
      return "failed";
  }
  return "";
}

std::string missingInput(const Case& c, Stage stage) {
  switch (stage) {
    case Stage::Images:
      if (c.images.size() == 2) return {};
      return "two radiographs are needed, there " +
             std::string(c.images.size() == 1 ? "is 1" : "are " + std::to_string(c.images.size()));
    case Stage::Landmarks:
      return c.sightings.empty() ? "no landmark has been picked" : "";
    case Stage::Skeleton:
      return hasWarning(c, Stage::Landmarks, kNoKnownLandmarks) && stateOf(c, Stage::Landmarks) == StageState::Done
                 ? "no known landmark of the skeleton has been picked"
                 : "";
    default:
      return {};
  }
}

std::string inputHash(const Case& c, Stage stage) {
  Json json{{"stage", nameOf(stage)}, {"revision", methodRevision(stage)}};
  json["inputs"] = inputsOf(c, stage);
  return sha256(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

StageState stateOf(const Case& c, Stage stage) {
  if (!missingInput(c, stage).empty()) return StageState::Missing;
  const auto before = stageBefore(stage);
  if (before && stateOf(c, *before) != StageState::Done)
    return hasResult(c, stage) ? StageState::Stale : StageState::Blocked;
  const auto it = c.stages.find(stage);
  const bool ran = it != c.stages.end() && it->second.outcome != Outcome::NotRun;
  const bool fresh = ran && it->second.input_hash == inputHash(c, stage);
  if (fresh && it->second.outcome == Outcome::Converged && hasResult(c, stage)) return StageState::Done;
  if (fresh && it->second.outcome == Outcome::NotConverged) return StageState::Failed;
  return hasResult(c, stage) ? StageState::Stale : StageState::Ready;
}

std::vector<std::string> reasonsAgainstReport(const Case& c) {
  std::vector<std::string> reasons;
  for (const Stage stage : kStages) {
    if (stage == Stage::Report) continue;
    const StageState state = stateOf(c, stage);
    if (state == StageState::Done) continue;
    const std::string missing = missingInput(c, stage);
    reasons.push_back(titleOf(stage) + ": " + nameOf(state) + (missing.empty() ? "" : " - " + missing));
  }
  return reasons;
}

}  // namespace sinew
