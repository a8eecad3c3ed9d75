#include "clinical/synthetic/synthetic_case.h"

#include <algorithm>
#include <cmath>

#include "clinical/case/case_io.h"
#include "clinical/synthetic/synthetic_exam.h"
#include "clinical/synthetic/synthetic_patient.h"
#include "core/file.h"
#include "core/retarget/prepared/reference.h"
#include "core/skeleton/shape/bone_field.h"

namespace sinew {
namespace {

/// The part of `job` between two fractions.
Job partOf(const Job& job, double from, double to) {
  return {
      [&job, from, to](double fraction, std::string_view stage) { job.report(from + fraction * (to - from), stage); },
      job.stop};
}

FileReference writeImage(const Radiograph& image, const std::filesystem::path& folder, const std::string& path) {
  std::filesystem::create_directories((folder / path).parent_path());
  writeDicom(image, folder / path);
  return {path, sha256OfFile(folder / path)};
}

Patient identityOf(const Skeleton& skeleton, unsigned seed) {
  Patient patient;
  patient.id = "SYNTHETIC-" + std::to_string(seed);
  patient.name = "Demo^Patient";
  patient.sex = seed % 2 ? "F" : "M";
  patient.birth_date = "2011-03-14";
  // Stature follows the legs: they are 0.489 of it in the reference (de Leva 1996); a slim build.
  const auto length_m = [&](const char* joint) {
    return skeleton.joints[std::size_t(skeleton.jointIndex(joint))].X_PJ.translation().norm();
  };
  const double legs_m = (length_m("knee_r") + length_m("knee_l") + length_m("ankle_r") + length_m("ankle_l")) / 2;
  patient.height_m = std::round(100 * legs_m / 0.489) / 100;
  patient.mass_kg = std::round(20.5 * *patient.height_m * *patient.height_m);
  return patient;
}

}  // namespace

SyntheticPatient drawSyntheticPatient(const RetargetReference& reference, const SyntheticOptions& options) {
  const Skeleton& reference_skeleton = reference.model().skeleton;
  // One stream of random numbers for each part, so that other options do not change the patient.
  RandomSource shape_source{options.seed, 1}, posture_source{options.seed, 2}, picking_source{options.seed, 3};
  SyntheticPatient patient;
  patient.shape = drawPatientShape(loadShapePriors(options.resource_dir), shape_source);
  const Skeleton skeleton = deformedSkeleton(reference_skeleton, patient.shape);
  patient.posture = drawPatientPosture(skeleton, floorHeight_m(options.rig), posture_source);
  patient.true_rig = drawTrueRig(options.rig, options.seed, options.binning, options.views);
  patient.sightings = drawSightings(skeleton, patient.posture, patient.true_rig, options.resource_dir,
                                    options.picking_noise_mm, picking_source);
  patient.patient = identityOf(skeleton, options.seed);
  patient.truth.figures = boneFigures(reference_skeleton, patient.shape, patient.posture);
  patient.truth.seed = options.seed;
  const SyntheticExam exam = drawExam(reference, patient.shape, patient.patient, options);
  patient.exam = exam.exam;
  patient.truth.length_factors = exam.length_factors;
  patient.patient.diagnosis = exam.diagnosis;
  return patient;
}

Case writeSyntheticCase(const SyntheticPatient& patient, const Model& reference, const SyntheticOptions& options,
                        const std::filesystem::path& folder, const Job& job) {
  Case c;
  c.patient = patient.patient;
  c.sightings = patient.sightings;
  c.exam = patient.exam;
  c.truth = patient.truth;
  const auto films = filmGeometry(options.rig, options.binning, options.views);
  const Model model = deformedModel(reference, patient.shape);
  const double share = 0.8 / double(films.size());
  for (std::size_t i = 0; i < films.size(); ++i) {
    const double from = share * double(i);
    const Radiograph image = renderRadiograph(model, patient.posture, patient.true_rig.views[i], options,
                                              films[i].view_position, partOf(job, from, from + share));
    if (job.cancelled()) return {};
    c.images.push_back({writeImage(image, folder, "images/view" + std::to_string(i + 1) + ".dcm"), {}});
  }
  if (options.rig == SyntheticRig::ConeBeam) {
    const CalibrationObject phantom = syntheticPhantom();
    c.phantom.emplace();
    for (std::size_t i = 0; i < films.size(); ++i) {
      job.report(0.8 + 0.2 * double(i) / double(films.size()),
                 "rendering the bead phantom, view " + std::to_string(i + 1));
      const Radiograph image =
          renderPhantom(phantom, patient.true_rig.views[i], options, films[i].view_position, {{}, job.stop});
      if (job.cancelled()) return {};
      c.phantom->images.push_back(
          writeImage(image, folder, "calibration/phantom_view" + std::to_string(i + 1) + ".dcm"));
    }
    const std::string beads = "calibration/beads.csv";
    saveCalibrationObject(phantom, folder / beads);
    c.phantom->beads = {beads, sha256OfFile(folder / beads)};
  }
  saveCase(c, folder);
  job.report(1, "case written");
  return c;
}

void expectDemoFolder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error) || std::filesystem::is_empty(folder, error)) return;
  if (std::filesystem::exists(folder / "case.json", error) && loadCase(folder).truth) return;
  throw InputError{{folder.string(), "", "an empty folder or an earlier demo", "other files, which are kept"}};
}

std::vector<TruthComparison> compareWithTruth(const Case& c) {
  std::vector<TruthComparison> rows;
  if (!c.truth || !c.skeleton) return rows;
  for (const auto& truth : c.truth->figures) {
    const auto& figures = c.skeleton->figures;
    const auto estimate = std::find_if(figures.begin(), figures.end(), [&](const BoneFigure& f) {
      return f.quantity == truth.quantity && f.side == truth.side;
    });
    if (estimate != figures.end())
      rows.push_back({truth.quantity, truth.side, truth.unit, truth.value, estimate->value, estimate->lower95,
                      estimate->upper95});
  }
  return rows;
}

}  // namespace sinew
