#include "app/experiments/popliteal.h"

#include "core/rom/tests/exam_test.h"

namespace sinew {

PoplitealRow poplitealRow(const std::filesystem::path& resource_dir, const Model& model, const std::string& body) {
  const ExamProtocol protocol = loadExamProtocol(resource_dir);
  const ExamTest& test = protocol.test("popliteal_unilateral");
  const SimulatedTest simulated = simulateTest(model, test, 'r', kPoplitealThreshold_Nm);
  return {body, simulated.angle_deg, simulated.stopped_by_joint, passiveMomentCurve(model, test, 'r')};
}

}  // namespace sinew
