#include "clinical/synthetic/synthetic_exam.h"

#include <cmath>

#include "clinical/case/patient_body.h"
#include "core/random_source.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

constexpr double kThresholdMass_kg = 75;  ///< the body that a protocol's thresholds are stated for

std::map<std::string, double> drawContractures(const ExamProtocol& protocol, RandomSource& random) {
  std::map<std::string, double> factors;
  const auto shorten = [&](const char* group, const std::string& side, double factor) {
    for (const auto& unit : protocol.group(group).units) factors[unit + "_" + side] = factor;
  };
  for (const char* side : {"r", "l"}) {
    shorten("hamstrings", side, random.uniform(0.90, 0.96));
    // The reference has a gymnast's hips: its hip flexors hold nobody back until they are a fifth shorter.
    shorten("hip_flexors", side, random.uniform(0.785, 0.815));
  }
  shorten("gastrocnemius", random.uniform() < 0.5 ? "r" : "l", random.uniform(0.94, 0.97));
  return factors;
}

}  // namespace

SyntheticExam drawExam(const RetargetReference& reference, const ShapeParameters& shape, const Patient& patient,
                       const SyntheticOptions& options) {
  const ExamProtocol protocol = loadExamProtocol(options.resource_dir);
  RandomSource contracture_source{options.seed, 4}, reading_source{options.seed, 5};
  SyntheticExam drawn;
  drawn.length_factors = drawContractures(protocol, contracture_source);
  drawn.diagnosis = "Synthetic: short hamstrings, hip flexors";
  drawn.exam.examiner = "Sinew (simulated)";
  drawn.exam.date = "2026-01-05";
  const RetargetOptions body{.physics = patientPhysics(patient, drawn.exam, shape, reference.model().skeleton)};
  const Model model = withLengthFactors(retarget(reference, shape, body).model, drawn.length_factors);
  for (const auto& test : protocol.tests)
    for (const char side : {'r', 'l'}) {
      const double noise_deg = options.exam_noise_deg * reading_source.normal();
      const SimulatedTest found =
          simulateTest(model, test, side, test.threshold_Nm * *patient.mass_kg / kThresholdMass_kg);
      ExamEntry entry;
      entry.test = test.id;
      entry.side = side;
      entry.measured_deg = std::round(found.angle_deg + noise_deg);
      drawn.exam.entries.push_back(entry);
    }
  return drawn;
}

}  // namespace sinew
