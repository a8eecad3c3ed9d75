#include <algorithm>
#include <array>

#include "clinical/case/case_io.h"
#include "clinical/pipeline/phantom_calibration.h"
#include "clinical/pipeline/stage_runs.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/text.h"
#include "imaging/rig/rig_from_dicom.h"

namespace sinew {
namespace {

std::array<Radiograph, 2> readPair(const Case& c, const PipelineContext& context) {
  const auto read = [&](const CaseImage& image) {
    return readRadiograph(checkedFile(image.file, context.case_dir), image.declared_spacing_mm);
  };
  return {read(c.images.at(0)), read(c.images.at(1))};
}

std::string viewName(std::size_t i) {
  return "view " + std::to_string(i + 1);
}

std::string sizeText(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px) + " px";
}

/// Doubts whether two radiographs were taken of one person on one occasion. Says nothing about who it is.
Warnings pairDoubts(const std::array<Radiograph, 2>& images) {
  const RadiographTags &a = images[0].tags, &b = images[1].tags;
  Warnings warnings;
  const auto differ = [](const std::string& x, const std::string& y) { return !x.empty() && !y.empty() && x != y; };
  if (differ(a.patient_id, b.patient_id) || differ(a.patient_birth_date, b.patient_birth_date))
    warnings.push_back({"different_patients", "the two radiographs name different patients"});
  if (differ(a.study_date, b.study_date))
    warnings.push_back({"different_dates", "the two radiographs were taken on different days"});
  if (differ(a.view_position, b.view_position) == false && !a.view_position.empty() && !b.view_position.empty())
    warnings.push_back({"same_view", "both radiographs say view position " + a.view_position});
  return warnings;
}

void expectSameSize(const View& view, const Radiograph& image, std::size_t i, const std::string& where) {
  if (view.width_px == image.width_px && view.height_px == image.height_px) return;
  throw InputError{{where, viewName(i), "an image of " + sizeText(view.width_px, view.height_px) + " as calibrated",
                    sizeText(image.width_px, image.height_px)}};
}

std::string calibrationSummary(const BiplanarRig& rig) {
  const auto& record = rig.calibration;
  std::string text = record.method + ", id " + record.id;
  if (std::isfinite(record.rms_px)) text += ", RMS " + rounded(record.rms_px, 2) + " px";
  if (std::isfinite(record.accuracy_mm)) text += ", accuracy " + rounded(record.accuracy_mm, 2) + " mm";
  return text;
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) text += (i ? ", " : "") + names[i];
  return names.size() > kMost ? text + ", ..." : text;
}

/// Which points the skeleton does not know, and which landmarks of the protocol nobody picked in both views.
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
    warnings.push_back({"landmarks_missing", std::to_string(missing.size()) +
                                                 (missing.size() == 1 ? " landmark" : " landmarks") +
                                                 " of the protocol not seen in both views: " + listed(missing)});
  return warnings;
}

}  // namespace

void addWarnings(Warnings& warnings, const Warnings& more, const std::string& source) {
  for (const auto& w : more) warnings.push_back({w.code, source.empty() ? w.message : source + ": " + w.message});
}

StageRun runImages(Case& c, const PipelineContext& context) {
  if (c.images[0].file.sha256 == c.images[1].file.sha256)
    throw InputError{{"images", "view 2", "another radiograph than view 1", "the same file twice"}};
  const auto images = readPair(c, context);
  StageRun run;
  for (std::size_t i = 0; i < 2; ++i) {
    addWarnings(run.warnings, images[i].warnings, viewName(i));
    const auto& spacing = images[i].spacing;
    run.summary += (i ? "; " : "") + viewName(i) + " " + sizeText(images[i].width_px, images[i].height_px) + ", " +
                   (spacing ? rounded(spacing->column_mm, 3) + " mm a pixel" : "pixel size not stated");
  }
  addWarnings(run.warnings, pairDoubts(images));
  return run;
}

StageRun runCalibration(Case& c, const PipelineContext& context, const Job& job) {
  if (c.phantom && c.imported_rig)
    throw InputError{{"calibration", "geometry", "images of a phantom or a rig file", "both"}};
  const auto images = readPair(c, context);
  StageRun run;
  std::size_t beads = 0;
  if (c.phantom) {
    const auto file = [&](const FileReference& reference) { return checkedFile(reference, context.case_dir); };
    auto calibration =
        calibrateFromPhantom({file(c.phantom->images[0]), file(c.phantom->images[1])}, file(c.phantom->beads), job);
    run.outcome = calibration.outcome;
    if (run.outcome != Outcome::Converged) return run;
    beads = calibration.residuals.size();
    c.rig = std::move(calibration.rig);
  } else {
    c.rig = c.imported_rig ? *c.imported_rig : rigFromDicom(images[0], images[1]);
  }
  for (std::size_t i = 0; i < 2; ++i) expectSameSize(c.rig->views[i], images[i], i, "calibration");
  addWarnings(run.warnings, c.rig->calibration.warnings);
  run.summary = calibrationSummary(*c.rig);
  if (beads) run.summary += ", " + std::to_string(beads) + " beads seen";
  return run;
}

StageRun runLandmarks(Case& c, const PipelineContext& context) {
  StageRun run;
  c.landmarks = triangulateAll(*c.rig, c.sightings);
  addWarnings(run.warnings, c.landmarks->warnings);
  addWarnings(run.warnings, coverage(c, context));
  run.summary = std::to_string(c.landmarks->points.size()) + " points in both views";
  if (std::isfinite(c.landmarks->rms_px)) run.summary += ", RMS " + rounded(c.landmarks->rms_px, 2) + " px";
  return run;
}

}  // namespace sinew
