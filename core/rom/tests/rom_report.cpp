#include "core/rom/tests/rom_report.h"

#include <algorithm>
#include <cmath>

#include "core/rom/tests/threshold.h"

namespace sinew {
namespace {

constexpr double kAccepted_deg = 1;  // beyond the range: norms are whole degrees, some of them single figures

TestNorm normOf(const std::map<std::string, TestNorm, std::less<>>& norms, std::string_view preset) {
  const auto found = norms.find(preset);
  return found == norms.end() ? TestNorm{} : found->second;
}

/// From the mean; where only a range is known, from its nearer end.
double off(const TestNorm& norm, double value_deg) {
  if (!std::isnan(norm.mean_deg)) return value_deg - norm.mean_deg;
  if (!norm.known()) return std::numeric_limits<double>::quiet_NaN();
  return value_deg < norm.accept_min_deg ? value_deg - norm.accept_min_deg
                                         : std::max(0.0, value_deg - norm.accept_max_deg);
}

}  // namespace

RomReport romReport(const Model& model, const ClinicalTests& tests, std::string_view preset, double mass_kg,
                    const Job& job) {
  RomReport report;
  for (const ClinicalTest& test : tests.tests) {
    if (job.cancelled()) return {.outcome = Outcome::Cancelled};
    job.report(double(report.tests.size()) / double(tests.tests.size()), "simulating " + test.title);
    RomTestLine line{
        .test = &test, .threshold_Nm = scaledThreshold_Nm(test, mass_kg), .norm = normOf(test.norms, preset)};
    line.reading = simulateTest(model, test, 'r', line.threshold_Nm);
    line.off_deg = off(line.norm, line.reading.angle_deg);
    line.accepted = !line.norm.known() || line.norm.outside_deg(line.reading.angle_deg) < kAccepted_deg;
    report.tests.push_back(std::move(line));
  }
  const auto angle_deg = [&](const std::string& id) {
    return std::ranges::find_if(report.tests, [&](const RomTestLine& l) { return l.test->id == id; })
        ->reading.angle_deg;
  };
  for (const TestCoupling& coupling : tests.couplings) {
    RomCouplingLine line{.coupling = &coupling, .norm = normOf(coupling.norms, preset)};
    line.difference_deg = coupling.sign * (angle_deg(coupling.first) - angle_deg(coupling.second));
    line.off_deg = off(line.norm, line.difference_deg);
    line.right_way = !coupling.must_be_positive || line.difference_deg > 0;
    report.couplings.push_back(line);
  }
  std::erase_if(report.tests, [](const RomTestLine& l) { return !l.norm.known(); });
  report.outcome = Outcome::Converged;
  return report;
}

}  // namespace sinew
