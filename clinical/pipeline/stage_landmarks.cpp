#include <algorithm>
#include <cmath>
#include <set>

#include "clinical/pipeline/side_check.h"
#include "clinical/pipeline/stage_inputs_json.h"
#include "clinical/pipeline/stage_table.h"
#include "clinical/pipeline/stage_words.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/text.h"
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
  return c.landmarks.has_value();
}

std::string missing(const Case& c, StageState) {
  return c.sightings.empty() ? "no landmark has been picked" : "";
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) text += (i ? ", " : "") + names[i];
  return names.size() > kMost ? text + ", ..." : text;
}

/// Which points the skeleton does not know, and which landmarks of the protocol nobody picked in two views.
Warnings coverage(const Case& c, const PipelineContext& context) {
  const auto& landmarks = context.reference->skeleton.landmarks;
  std::vector<std::string> known, foreign;
  for (const auto& landmark : landmarks) known.push_back(landmark.name);
  bool any_known = false;
  for (const auto& sighting : c.sightings) {
    if (std::ranges::find(known, sighting.name) != known.end()) {
      any_known = true;
    } else if (std::ranges::find(foreign, sighting.name) == foreign.end()) {
      foreign.push_back(sighting.name);
    }
  }
  if (!any_known)
    return {{std::string{kNoKnownLandmarks}, "none of the points is a landmark of the skeleton: " + listed(foreign)}};
  Warnings warnings;
  for (const auto& name : foreign)
    warnings.push_back(
        {"unknown_landmark", "'" + name + "' is no landmark of the skeleton" + didYouMean(name, known)});
  std::vector<std::string> missing;
  for (const auto& wanted : loadLandmarkProtocol(context.resource_dir))
    if (std::ranges::none_of(c.landmarks->points, [&](const auto& p) { return p.name == wanted.name; }))
      missing.push_back(wanted.name);
  if (!missing.empty())
    warnings.push_back({"landmarks_missing", counted(missing.size(), "landmark", "landmarks") +
                                                 " of the protocol not seen in two views: " + listed(missing)});
  return warnings;
}

/// Position of every landmark seen in two views or more, and which ones of the protocol are missing.
StageRun run(Case& c, const PipelineContext& context, const Job& job) {
  StageRun run;
  c.landmarks = triangulateAll(*c.rig, c.sightings);
  addWarnings(run.warnings, c.landmarks->warnings);
  addWarnings(run.warnings, coverage(c, context));
  const auto finding = examineSides(context.reference->skeleton, *c.rig, c.sightings, context.resource_dir, job);
  if (job.cancelled()) return {.outcome = Outcome::Cancelled, .warnings = {}, .summary = {}};
  c.exchanged_sides = finding.exchanges;
  addWarnings(run.warnings, warningsOf(finding));
  run.summary = std::to_string(c.landmarks->points.size()) +
                (c.rig->views.size() == 2 ? " points in both views" : " points in two views or more");
  if (std::isfinite(c.landmarks->rms_px)) run.summary += ", RMS " + rounded(c.landmarks->rms_px, 2) + " px";
  return run;
}

void copyResult(Case& to, const Case& from) {
  to.landmarks = from.landmarks;
  to.exchanged_sides = from.exchanged_sides;
}

std::string entered(const Case& c) {
  if (c.sightings.empty()) return "No landmark placed";
  std::set<std::string> names;
  for (const auto& s : c.sightings) names.insert(s.name);
  return counted(names.size(), "landmark", "landmarks") + " placed";
}

std::string resultLine(const Case& c) {
  if (!c.landmarks) return {};
  const std::string points = counted(c.landmarks->points.size(), "point", "points");
  return std::isfinite(c.landmarks->rms_px) ? points + ", RMS " + rounded(c.landmarks->rms_px, 2) + " px" : points;
}

}  // namespace

constinit const StageRow kLandmarksRow{.stage = Stage::Landmarks,
                                       .name = "landmarks",
                                       .title = "Landmarks",
                                       .revision = 2,
                                       .resources = kResources,
                                       .inputs = inputs,
                                       .has_result = hasResult,
                                       .missing = missing,
                                       .run = run,
                                       .copy_result = copyResult,
                                       .to_enter = "Place landmarks in two radiographs or more.",
                                       .entered = entered,
                                       .result_line = resultLine};

}  // namespace sinew
