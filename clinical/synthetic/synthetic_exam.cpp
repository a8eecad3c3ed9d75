#include "clinical/synthetic/synthetic_exam.h"

#include <algorithm>
#include <cmath>

#include "clinical/case/patient_body.h"
#include "core/random_source.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "core/rom/tests/clinical_sweep.h"
#include "core/rom/tests/threshold.h"

namespace sinew {
namespace {

std::map<std::string, double> drawContractures(const ClinicalTests& protocol, RandomSource& random) {
  std::map<std::string, double> factors;
  const auto shorten = [&](const char* group, const std::string& side, double factor) {
    for (const auto& unit : protocol.group(group).units) factors[unit + "_" + side] = factor;
  };
  for (const char* side : {"r", "l"}) {
    shorten("hamstrings", side, random.uniform(0.91, 0.95));
    // Hip flexors hold nobody back until they are a fifth shorter: the capsule does.
    shorten("hip_flexors", side, random.uniform(0.78, 0.80));
  }
  shorten("gastrocnemius", random.uniform() < 0.5 ? "r" : "l", random.uniform(0.91, 0.94));
  return factors;
}

}  // namespace

SyntheticExam drawExam(const RetargetReference& reference, const ShapeParameters& shape, const Patient& patient,
                       const SyntheticOptions& options) {
  const ClinicalTests protocol = loadClinicalTests(options.resource_dir);
  RandomSource contracture_source{options.seed, 4}, reading_source{options.seed, 5};
  SyntheticExam drawn;
  drawn.length_factors = drawContractures(protocol, contracture_source);
  drawn.diagnosis = "Synthetic: short hamstrings, hip flexors";
  drawn.exam.examiner = "Sinew (simulated)";
  drawn.exam.date = "2026-01-05";
  const RetargetOptions body{.physics = patientPhysics(patient, drawn.exam, shape, reference.model().skeleton)};
  const Model model = withLengthFactors(retarget(reference, shape, body).model, drawn.length_factors);
  for (const ClinicalTest* test : protocol.form())
    for (const char side : {'r', 'l'}) {
      const double noise_deg = options.exam_noise_deg * reading_source.normal();
      const double found_deg =
          simulateTest(model, *test, side, scaledThreshold_Nm(*test, *patient.mass_kg)).written_deg;
      ExamEntry entry;
      entry.test = test->id;
      entry.side = side;
      // Contractures of the hip keep some tests from their very posture; an examiner says so.
      if (found_deg < test->form->doubt_min_deg || found_deg > test->form->doubt_max_deg)
        entry.note = "the posture cannot be taken";
      else  // a form has no room for less than its least angle: a hyperextended knee is written as straight
        entry.measured_deg =
            std::clamp(std::round(found_deg + noise_deg), test->form->entry_min_deg, test->form->entry_max_deg);
      drawn.exam.entries.push_back(entry);
    }
  return drawn;
}

}  // namespace sinew
