#include "app/experiments/popliteal.h"

#include "core/rom/tests/clinical_sweep.h"

namespace sinew {

PoplitealRow poplitealRow(const std::filesystem::path& resource_dir, const Model& model, const std::string& body) {
  const ClinicalTests tests = loadClinicalTests(resource_dir);
  const ClinicalTest& test = tests.test("popliteal_unilateral");
  const SimulatedTest simulated = simulateTest(model, test, 'r', kPoplitealThreshold_Nm);
  return {body, simulated.written_deg, simulated.stopped_by_joint, passiveMomentCurve(model, test, 'r')};
}

}  // namespace sinew
