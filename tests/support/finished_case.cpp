#include "tests/support/finished_case.h"

#include <algorithm>
#include <memory>

#include "clinical/case/case_io.h"
#include "clinical/case/patient_body.h"
#include "clinical/pipeline/patient_fit.h"
#include "clinical/pipeline/pipeline.h"
#include "clinical/synthetic/synthetic_patient.h"
#include "clinical/synthetic/synthetic_rig.h"
#include "core/file.h"
#include "core/rom/tests/clinical_sweep.h"
#include "core/rom/tests/threshold.h"
#include "imaging/radiograph/radiograph.h"
#include "imaging/rig/triangulate.h"
#include "tests/support/resources.h"

namespace sinew::test {
namespace {

constexpr unsigned kSeed = 11;
constexpr double kMass_kg = 58;

CaseImage plainImage(const View& view, const std::filesystem::path& folder, const std::string& name) {
  Radiograph film;
  film.width_px = view.width_px;
  film.height_px = view.height_px;
  film.bits_stored = 12;
  film.pixels = std::make_shared<const std::vector<std::uint16_t>>(
      std::size_t(view.width_px) * std::size_t(view.height_px), std::uint16_t{900});
  film.window_center = 1500;
  film.window_width = 3000;
  film.tags.modality = "DX";
  film.tags.study_date = "20260504";
  film.tags.sop_instance_uid = "1.2.826.0.1.3680043.8.498." + std::to_string(view.width_px);
  std::filesystem::create_directories(folder / "images");
  const auto path = folder / "images" / (name + ".dcm");
  writeDicom(film, path);
  return {{"images/" + name + ".dcm", sha256OfFile(path)}, {}};
}

/// The tests on a body whose right hamstrings are short; the left popliteal angle was not possible.
PhysicalExam examOf(const Model& body, const ClinicalTests& protocol) {
  std::map<std::string, double> short_hamstrings;
  for (const auto& group : protocol.groups)
    if (group.name == "hamstrings")
      for (const auto& unit : group.units) short_hamstrings[unit + "_r"] = 0.92;
  const Model patient = withLengthFactors(body, short_hamstrings);
  PhysicalExam exam;
  exam.date = "2026-05-06";
  exam.examiner = "A. Examiner";
  for (const ClinicalTest* row : protocol.form())
    for (const char side : {'r', 'l'}) {
      const ClinicalTest& test = *row;
      ExamEntry entry{test.id, side, {}, "", {}};
      if (test.id == "popliteal_unilateral" && side == 'l')
        entry.note = "pain";
      else
        entry.measured_deg =
            std::max(simulateTest(patient, test, side, scaledThreshold_Nm(test, kMass_kg)).written_deg,
                     test.form->entry_min_deg);
      exam.entries.push_back(entry);
    }
  return exam;
}

}  // namespace

void markDone(Case& c, Stage stage, const Warnings& warnings) {
  StageRecord record;
  record.outcome = Outcome::Converged;
  record.warnings = warnings;
  c.stages[stage] = record;
  c.stages[stage].input_hash = inputHash(c, stage, resourceDir());
}

Case finishedCase(const Model& reference, const std::filesystem::path& folder) {
  RandomSource random{kSeed};
  const auto priors = loadShapePriors(resourceDir());
  const auto shape = drawPatientShape(priors, random);
  const Model body = deformedModel(reference, shape);
  BiplanarRig rig = drawTrueRig(SyntheticRig::ConeBeam, kSeed);
  rig.calibration.method = "bead_phantom";
  rig.calibration.id = "c0ffee";
  rig.calibration.rms_px = 0.21;
  const Posture posture = drawPatientPosture(body.skeleton, floorHeight_m(SyntheticRig::ConeBeam), random);

  Case c;
  c.patient = {"P-0042", "Hong^Gildong=洪^吉洞=홍^길동", "M", "2008-02-11", "spastic diplegia", 1.71, kMass_kg};
  c.images = {plainImage(rig.views[0], folder, "view1"), plainImage(rig.views[1], folder, "view2")};
  c.sightings = drawSightings(body.skeleton, posture, rig, resourceDir(), 1.0, random);
  const auto protocol = loadClinicalTests(resourceDir());
  c.exam = examOf(body, protocol);

  c.rig = rig;
  c.landmarks = triangulateAll(rig, c.sightings);
  c.skeleton = fitPatient(reference.skeleton, rig, c.sightings, resourceDir());
  const Model fitted = deformedModel(reference, c.skeleton->shape);
  c.exam_fit = applyExam(fitted, c.exam, protocol, {kMass_kg, ageYears(c.patient, c.exam), c.patient.sex});
  std::filesystem::create_directories(folder / "results");
  saveModel(fitted, folder / "results/musculature.json");
  c.musculature = FileReference{"results/musculature.json", sha256OfFile(folder / "results/musculature.json")};
  saveModel(withLengthFactors(fitted, c.exam_fit->length_factors), folder / "results/model.json");
  c.model = FileReference{"results/model.json", sha256OfFile(folder / "results/model.json")};
  for (const Stage stage : kStages)
    if (stage != Stage::Report) markDone(c, stage);
  return c;
}

}  // namespace sinew::test
