#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/job.h"
#include "core/rom/tests/clinical_sweep.h"

namespace sinew {

/// One test of the norms on one model.
struct RomTestLine {
  const ClinicalTest* test = nullptr;
  SimulatedTest reading;
  double threshold_Nm = 0;                                    ///< of this body
  TestNorm norm;                                              ///< of the preset compared with; perhaps unknown
  double off_deg = std::numeric_limits<double>::quiet_NaN();  ///< from the mean; from the range if there is none
  bool accepted = true;                                       ///< inside the accepted range, within a degree
};

/// One dependence of a joint on another.
struct RomCouplingLine {
  const TestCoupling* coupling = nullptr;
  double difference_deg = std::numeric_limits<double>::quiet_NaN();  ///< simulated
  TestNorm norm;
  double off_deg = std::numeric_limits<double>::quiet_NaN();
  bool right_way = true;  ///< positive where anatomy wants it
};

struct RomReport {
  Outcome outcome = Outcome::NotRun;
  std::vector<RomTestLine> tests;
  std::vector<RomCouplingLine> couplings;
};

/// All tests that have a norm of `preset`, on the right side, with the examiner's moment for a body of `mass_kg`.
/// `tests` must outlive the report.
RomReport romReport(const Model& model, const ClinicalTests& tests, std::string_view preset, double mass_kg,
                    const Job& job = {});

}  // namespace sinew
