#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/job.h"
#include "core/rom/tests/rom_test.h"

namespace sinew {

/// One test of the norms on one model.
struct RomTestLine {
  const RomTest* test = nullptr;
  RomReading reading;
  RomNorm norm;                                               ///< of the preset compared with; perhaps unknown
  double off_deg = std::numeric_limits<double>::quiet_NaN();  ///< from the mean; from the range if there is none
  bool accepted = true;                                       ///< inside the accepted range, within a degree
};

/// One dependence of a joint on another.
struct RomCouplingLine {
  const RomCoupling* coupling = nullptr;
  double difference_deg = std::numeric_limits<double>::quiet_NaN();  ///< simulated
  RomNorm norm;
  double off_deg = std::numeric_limits<double>::quiet_NaN();
  bool right_way = true;  ///< positive where anatomy wants it
};

struct RomReport {
  Outcome outcome = Outcome::NotRun;
  std::vector<RomTestLine> tests;
  std::vector<RomCouplingLine> couplings;
};

/// All tests of `norms` that have a norm of `preset`, on the right side. `norms` must outlive the report.
RomReport romReport(const Model& model, const RomNorms& norms, std::string_view preset, const Job& job = {});

}  // namespace sinew
