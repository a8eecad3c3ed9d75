#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "clinical/case/case.h"
#include "clinical/synthetic/synthetic_rig.h"
#include "core/job.h"
#include "core/model/model.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {

class RetargetReference;

struct SyntheticOptions {
  std::filesystem::path resource_dir;  ///< priors, landmark protocol, examination tests
  unsigned seed = 1;
  SyntheticRig rig = SyntheticRig::ConeBeam;
  int views = 2;                  ///< 3: with an oblique film (cone beam)
  double picking_noise_mm = 1.0;  ///< SD of a landmark pick, in the plane of the patient
  double exam_noise_deg = 0;
  bool noise_in_images = true;
  int binning = 1;  ///< pixels of the detector joined into one; 2 quarters size and time of the images
};

/// A patient whose truth is known: shape and posture drawn from the population priors, a tight or slack muscle group,
/// geometry of the views, landmark picks, simulated examination.
struct SyntheticPatient {
  ShapeParameters shape;
  Posture posture;
  BiplanarRig true_rig;
  std::vector<Sighting> sightings;
  PhysicalExam exam;
  Truth truth;
  Patient patient;  ///< clearly synthetic: "Demo^Patient", id "SYNTHETIC-1"
};
/// Deterministic in the options. No images yet.
SyntheticPatient drawSyntheticPatient(const RetargetReference& reference, const SyntheticOptions& options);

/// Radiograph of posed bones and a soft-tissue envelope: attenuation (Beer-Lambert; fat, muscle, compact and spongy
/// bone) integrated along the ray of every pixel, scatter, quantum noise, detector blur, R/L marker, collimation; a
/// true DX image in memory. `view_position` is that of one of the rig's films ("AP", "LL", "LPO"; "PA", "LL"), whose
/// geometry tags it gets; `view` may be any view of the same field. No pixels if the job was cancelled.
Radiograph renderRadiograph(const Model& model, const Posture& posture, const View& view,
                            const SyntheticOptions& options, const std::string& view_position, const Job& job = {});

/// Radiograph of the bead phantom (steel balls in posts of foam) in the same way.
Radiograph renderPhantom(const CalibrationObject& phantom, const View& view, const SyntheticOptions& options,
                         const std::string& view_position, const Job& job = {});

/// Only an empty folder or an earlier demo is written into. @throws InputError otherwise.
void expectDemoFolder(const std::filesystem::path& folder);

/// Writes a whole case folder: the DICOM radiographs, phantom images and beads (cone beam), picks, exam, truth.
/// The case has run no stage yet. Cancelled: returns an empty case and leaves no case.json.
Case writeSyntheticCase(const SyntheticPatient& patient, const Model& reference, const SyntheticOptions& options,
                        const std::filesystem::path& folder, const Job& job = {});

/// Truth beside estimate, for the demo, the report and the benchmark.
struct TruthComparison {
  std::string quantity, side, unit;
  double truth = 0, estimate = 0, lower95 = 0, upper95 = 0;
};
std::vector<TruthComparison> compareWithTruth(const Case& c);

}  // namespace sinew
