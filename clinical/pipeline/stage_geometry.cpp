#include <algorithm>
#include <functional>

#include "clinical/case/case_io.h"
#include "clinical/pipeline/phantom_calibration.h"
#include "clinical/pipeline/stage_runs.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/text.h"
#include "imaging/rig/rig_from_dicom.h"

namespace sinew {
namespace {

std::vector<Radiograph> readImages(const Case& c, const PipelineContext& context) {
  std::vector<Radiograph> images;
  for (const auto& image : c.images)
    images.push_back(readRadiograph(checkedFile(image.file, context.case_dir), image.declared_spacing_mm));
  return images;
}

std::string viewName(std::size_t i) {
  return "view " + std::to_string(i + 1);
}

std::string sizeText(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px) + " px";
}

/// Doubts whether the radiographs were taken of one person on one occasion. Says nothing about who it is.
Warnings doubtsAbout(const std::vector<Radiograph>& images) {
  const std::string which = images.size() == 2 ? "the two radiographs" : "the radiographs";
  const auto values = [&](std::string RadiographTags::*field) {
    std::vector<std::string> stated;
    for (const auto& image : images)
      if (!(image.tags.*field).empty()) stated.push_back(image.tags.*field);
    return stated;
  };
  const auto differ = [&](std::string RadiographTags::*field) {
    const auto stated = values(field);
    return std::ranges::adjacent_find(stated, std::ranges::not_equal_to{}) != stated.end();
  };
  Warnings warnings;
  if (differ(&RadiographTags::patient_id) || differ(&RadiographTags::patient_birth_date))
    warnings.push_back({"different_patients", which + " name different patients"});
  if (differ(&RadiographTags::study_date))
    warnings.push_back({"different_dates", which + " were taken on different days"});
  const auto positions = values(&RadiographTags::view_position);
  if (positions.size() == images.size() && !differ(&RadiographTags::view_position))
    warnings.push_back({"same_view", (images.size() == 2 ? "both" : "all") +
                                         std::string{" radiographs say view position "} + positions.front()});
  return warnings;
}

/// @throws InputError if two images are the same file.
void requireDifferentFiles(const std::vector<CaseImage>& images) {
  for (std::size_t i = 0; i < images.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (images[i].file.sha256 == images[k].file.sha256)
        throw InputError{{"images", viewName(i), "another radiograph than " + viewName(k), "the same file twice"}};
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
    warnings.push_back({"landmarks_missing", std::to_string(missing.size()) +
                                                 (missing.size() == 1 ? " landmark" : " landmarks") +
                                                 " of the protocol not seen in two views: " + listed(missing)});
  return warnings;
}

}  // namespace

void addWarnings(Warnings& warnings, const Warnings& more, const std::string& source) {
  for (const auto& w : more) warnings.push_back({w.code, source.empty() ? w.message : source + ": " + w.message});
}

StageRun runImages(Case& c, const PipelineContext& context) {
  requireDifferentFiles(c.images);
  const auto images = readImages(c, context);
  StageRun run;
  for (std::size_t i = 0; i < images.size(); ++i) {
    addWarnings(run.warnings, images[i].warnings, viewName(i));
    const auto& spacing = images[i].spacing;
    run.summary += (i ? "; " : "") + viewName(i) + " " + sizeText(images[i].width_px, images[i].height_px) + ", " +
                   (spacing ? rounded(spacing->column_mm, 3) + " mm a pixel" : "pixel size not stated");
  }
  addWarnings(run.warnings, doubtsAbout(images));
  return run;
}

StageRun runCalibration(Case& c, const PipelineContext& context, const Job& job) {
  if (c.phantom && c.imported_rig)
    throw InputError{{"calibration", "geometry", "images of a phantom or a rig file", "both"}};
  const auto images = readImages(c, context);
  StageRun run;
  std::size_t beads = 0;
  if (c.phantom) {
    const auto file = [&](const FileReference& reference) { return checkedFile(reference, context.case_dir); };
    std::vector<std::filesystem::path> phantom;
    for (const auto& image : c.phantom->images) phantom.push_back(file(image));
    auto calibration = calibrateFromPhantom(phantom, file(c.phantom->beads), job);
    run.outcome = calibration.outcome;
    if (run.outcome != Outcome::Converged) return run;
    beads = calibration.residuals.size();
    c.rig = std::move(calibration.rig);
  } else {
    c.rig = c.imported_rig ? *c.imported_rig : rigFromDicom(images);
  }
  if (c.rig->views.size() != images.size())
    throw InputError{{"calibration", "views", std::to_string(images.size()) + ", one for every radiograph",
                      std::to_string(c.rig->views.size())}};
  for (std::size_t i = 0; i < images.size(); ++i) expectSameSize(c.rig->views[i], images[i], i, "calibration");
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
  run.summary = std::to_string(c.landmarks->points.size()) +
                (c.rig->views.size() == 2 ? " points in both views" : " points in two views or more");
  if (std::isfinite(c.landmarks->rms_px)) run.summary += ", RMS " + rounded(c.landmarks->rms_px, 2) + " px";
  return run;
}

}  // namespace sinew
