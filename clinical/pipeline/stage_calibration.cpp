#include <cmath>

#include "clinical/case/case_io.h"
#include "clinical/pipeline/image_pair.h"
#include "clinical/pipeline/phantom_calibration.h"
#include "clinical/pipeline/stage_inputs_json.h"
#include "clinical/pipeline/stage_table.h"
#include "clinical/pipeline/stage_words.h"
#include "imaging/rig/biplanar_rig_json.h"
#include "imaging/rig/rig_from_dicom.h"

namespace sinew {
namespace {

std::string inputs(const Case& c) {
  const auto hashes = [](const PhantomImages& phantom) {
    Json list = Json::array();
    for (const auto& image : phantom.images) list.push_back(image.sha256);
    list.push_back(phantom.beads.sha256);
    return list;
  };
  return inputText({{"images", imageInputs(c.images)},
                    {"phantom", orNull(c.phantom, hashes)},
                    {"imported_rig", orNull(c.imported_rig, rigToJson)}});
}

bool hasResult(const Case& c) {
  return c.rig.has_value();
}

void expectSameSize(const View& view, const Radiograph& image, std::size_t i) {
  if (view.width_px == image.width_px && view.height_px == image.height_px) return;
  throw InputError{{"calibration", viewName(i),
                    "an image of " + sizeText(view.width_px, view.height_px) + " as calibrated",
                    sizeText(image.width_px, image.height_px)}};
}

std::string summaryOf(const BiplanarRig& rig) {
  const auto& record = rig.calibration;
  std::string text = record.method + ", id " + record.id;
  if (std::isfinite(record.rms_px)) text += ", RMS " + rounded(record.rms_px, 2) + " px";
  if (std::isfinite(record.accuracy_mm)) text += ", accuracy " + rounded(record.accuracy_mm, 2) + " mm";
  return text;
}

/// Geometry of the views, from bead phantom, imported rig or DICOM attributes.
StageRun run(Case& c, const PipelineContext& context, const Job& job) {
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
  for (std::size_t i = 0; i < images.size(); ++i) expectSameSize(c.rig->views[i], images[i], i);
  addWarnings(run.warnings, c.rig->calibration.warnings);
  run.summary = summaryOf(*c.rig);
  if (beads) run.summary += ", " + std::to_string(beads) + " beads seen";
  return run;
}

void copyResult(Case& to, const Case& from) {
  to.rig = from.rig;
}

std::string entered(const Case& c) {
  return c.imported_rig ? "Imported geometry" : c.phantom ? "Bead phantom" : "From the image tags";
}

std::string resultLine(const Case& c) {
  if (!c.rig) return {};
  const auto& record = c.rig->calibration;
  const std::string method = calibrationMethodTitle(record.method);
  return std::isfinite(record.rms_px) ? method + ", " + rounded(record.rms_px, 2) + " px" : method;
}

}  // namespace

constinit const StageRow kCalibrationRow{.stage = Stage::Calibration,
                                         .name = "calibration",
                                         .title = "Calibration",
                                         .revision = 1,
                                         .resources = {},
                                         .inputs = inputs,
                                         .has_result = hasResult,
                                         .run = run,
                                         .copy_result = copyResult,
                                         .to_enter = "State the geometry of the radiographs.",
                                         .entered = entered,
                                         .result_line = resultLine};

}  // namespace sinew
