#include "core/rom/tests/rom_report.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr double kAccepted_deg = 1;  // beyond the range: norms are whole degrees, some of them single figures

RomNorm normOf(const std::map<std::string, RomNorm, std::less<>>& norms, std::string_view preset) {
  const auto found = norms.find(preset);
  return found == norms.end() ? RomNorm{} : found->second;
}

/// From the mean; where only a range is known, from its nearer end.
double off(const RomNorm& norm, double value_deg) {
  if (!std::isnan(norm.mean_deg)) return value_deg - norm.mean_deg;
  if (!norm.known()) return std::numeric_limits<double>::quiet_NaN();
  return value_deg < norm.accept_min_deg ? value_deg - norm.accept_min_deg
                                         : std::max(0.0, value_deg - norm.accept_max_deg);
}

}  // namespace

RomReport romReport(const Model& model, const RomNorms& norms, std::string_view preset, const Job& job) {
  RomReport report;
  for (const RomTest& test : norms.tests) {
    if (job.cancelled()) return {.outcome = Outcome::Cancelled};
    job.report(double(report.tests.size()) / double(norms.tests.size()), "simulating " + test.title);
    RomTestLine line{.test = &test, .reading = simulateRomTest(model, test), .norm = normOf(test.norms, preset)};
    line.off_deg = off(line.norm, line.reading.angle_deg);
    line.accepted = !line.norm.known() || line.norm.outside_deg(line.reading.angle_deg) < kAccepted_deg;
    report.tests.push_back(std::move(line));
  }
  const auto angle_deg = [&](const std::string& id) {
    return std::ranges::find_if(report.tests, [&](const RomTestLine& l) { return l.test->id == id; })
        ->reading.angle_deg;
  };
  for (const RomCoupling& coupling : norms.couplings) {
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
