#include <ceres/ceres.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>

#include "clinical/exam/physical_exam.h"
#include "core/angle.h"
#include "core/ceres_job_internal.h"
#include "core/rom/tests/exam_sweep.h"

namespace sinew {
namespace {

constexpr double kReferenceMass_kg = 75;  // thresholds are stated for this body
constexpr double kLeastFactor = 0.6, kMostFactor = 1.4;
constexpr double kFactorPrior = 0.3;  // SD of the weak pull to 1: moves a measured angle by less than 0.5 deg
constexpr double kUnchanged = 1e-4;   // a factor nearer to 1 than this is no change

/// A test that was measured on one side, ready to be simulated for any lengths.
struct MeasuredTest {
  const ExamTest* test;
  double measured_deg;
  double threshold_Nm;
  ExamSweep sweep;
};

/// A group of units whose common length factor is an unknown.
struct FreeGroup {
  const LengthGroup* group;
  std::vector<int> units;
};

std::map<int, double> factorsByUnit(const std::vector<FreeGroup>& groups, const double* factors) {
  std::map<int, double> by_unit;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const int unit : groups[g].units) by_unit[unit] = factors[g];
  return by_unit;
}

/// One residual a measured test: (simulated - measured) / SD [-], in written degrees. Beyond the joint's stop the
/// muscles' own angle counts, unless the measurement is the stop itself; then muscles that hold later are right.
class ExamResiduals {
 public:
  ExamResiduals(const std::vector<MeasuredTest>& tests, const std::vector<FreeGroup>& groups)
      : tests_{tests}, groups_{groups} {}

  bool operator()(double const* const* factors, double* residuals) const {
    const auto by_unit = factorsByUnit(groups_, factors[0]);
    for (std::size_t i = 0; i < tests_.size(); ++i) {
      const MeasuredTest& t = tests_[i];
      const double angle_rad = t.sweep.freeAngle_rad(t.threshold_Nm, by_unit);
      const double past_stop_rad = (angle_rad - t.sweep.stop_rad()) * t.sweep.direction();
      const double stop_deg = t.sweep.written_deg(t.sweep.stop_rad());
      constexpr double kAtStop_deg = 0.5;
      const bool measured_at_stop = std::abs(t.measured_deg - stop_deg) < kAtStop_deg;
      residuals[i] = past_stop_rad > 0 && measured_at_stop
                         ? 0
                         : (t.sweep.written_deg(angle_rad) - t.measured_deg) / t.test->measurement_sd_deg;
    }
    for (std::size_t g = 0; g < groups_.size(); ++g)
      residuals[tests_.size() + g] = (factors[0][g] - 1) / kFactorPrior;
    return true;
  }

 private:
  const std::vector<MeasuredTest>& tests_;
  const std::vector<FreeGroup>& groups_;
};

std::vector<FreeGroup> freeGroups(const Model& model, const ExamProtocol& protocol,
                                  const std::vector<MeasuredTest>& tests, char side) {
  std::vector<FreeGroup> groups;
  for (const auto& group : protocol.groups) {
    const bool tested = std::ranges::any_of(
        tests, [&](const MeasuredTest& t) { return std::ranges::count(t.test->muscle_groups, group.name) > 0; });
    if (!tested) continue;
    groups.push_back({&group, {}});
    for (const auto& unit : group.units)
      groups.back().units.push_back(model.musculature.unitIndex(unit + "_" + side));
  }
  return groups;
}

double thresholdOf(const ExamTest& test, const ExamEntry* entry, double mass_kg) {
  return entry && entry->threshold_Nm ? *entry->threshold_Nm : test.threshold_Nm * mass_kg / kReferenceMass_kg;
}

const ExamEntry* entryOf(const PhysicalExam& exam, const std::string& test, char side) {
  const auto found =
      std::ranges::find_if(exam.entries, [&](const ExamEntry& e) { return e.test == test && e.side == side; });
  return found == exam.entries.end() ? nullptr : &*found;
}

struct SideFit {
  Outcome outcome = Outcome::Converged;
  std::map<int, double> factors;
};

double costOf(const ExamResiduals& residuals, std::size_t count, const std::vector<double>& factors) {
  std::vector<double> values(count);
  const double* blocks[] = {factors.data()};
  residuals(blocks, values.data());
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

/// Where the solver may start. A muscle that is too long to hold anywhere leaves the simulated angle at the end of
/// the movement, without a slope to follow; so one group after the other is tried over its whole range, twice because
/// tests share groups.
std::vector<double> bestStart(const ExamResiduals& residuals, std::size_t residual_count, std::size_t groups) {
  constexpr double kStep = 0.02;
  std::vector<double> best(groups, 1.0);
  double least = costOf(residuals, residual_count, best);
  for (int round = 0; round < 2; ++round)
    for (std::size_t g = 0; g < groups; ++g) {
      auto tried = best;
      for (double factor = kLeastFactor; factor < kMostFactor; factor += kStep) {
        tried[g] = factor;
        if (const double cost = costOf(residuals, residual_count, tried); cost < least) least = cost, best = tried;
      }
    }
  return best;
}

SideFit solveSide(const std::vector<MeasuredTest>& tests, const std::vector<FreeGroup>& groups, char side,
                  const Job& job, double from, double to) {
  SideFit fit;
  if (groups.empty()) return fit;
  auto factors = bestStart({tests, groups}, tests.size() + groups.size(), groups.size());
  // The angles come from a bisection (1e-7 rad): differences over 1e-4 of a length are exact to 0.1 %.
  ceres::NumericDiffOptions differences;
  differences.relative_step_size = 1e-4;
  auto* cost = new ceres::DynamicNumericDiffCostFunction<ExamResiduals, ceres::CENTRAL>(
      new ExamResiduals{tests, groups}, ceres::TAKE_OWNERSHIP, differences);
  cost->AddParameterBlock(static_cast<int>(groups.size()));
  cost->SetNumResiduals(static_cast<int>(tests.size() + groups.size()));
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, factors.data());
  for (int g = 0; g < static_cast<int>(groups.size()); ++g) {
    problem.SetParameterLowerBound(factors.data(), g, kLeastFactor);
    problem.SetParameterUpperBound(factors.data(), g, kMostFactor);
  }
  constexpr int kIterations = 60;
  CeresJob monitor{job, side == 'r' ? "solving muscle lengths, right" : "solving muscle lengths, left", kIterations,
                   from, to};
  ceres::Solver::Options options = solverOptions(monitor, kIterations);
  options.function_tolerance = 1e-9;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  fit.outcome = outcomeOf(summary);
  if (fit.outcome == Outcome::Converged) fit.factors = factorsByUnit(groups, factors.data());
  return fit;
}

std::vector<LengthChange> changesOf(const Model& model, const ExamProtocol& protocol, const ExamTest& test, char side,
                                    const std::map<int, double>& factors) {
  std::vector<LengthChange> changes;
  for (const auto& name : test.muscle_groups)
    for (const auto& unit : protocol.group(name).units) {
      const int index = model.musculature.unitIndex(unit + "_" + side);
      const auto factor = factors.find(index);
      changes.push_back({unit + "_" + side, factor == factors.end() ? 1.0 : factor->second});
    }
  return changes;
}

/// Every test of the protocol on one side, tabulated once.
std::vector<ExamSweep> sweepsOf(const Model& model, const ExamProtocol& protocol, char side, const Job& job,
                                double from) {
  std::vector<ExamSweep> sweeps;
  for (const auto& test : protocol.tests) {
    if (job.cancelled()) break;
    job.report(from + 0.2 * double(sweeps.size()) / double(protocol.tests.size()),
               "simulating " + test.title + (side == 'r' ? ", right" : ", left"));
    sweeps.emplace_back(model, test, side);
  }
  return sweeps;
}

ExamComparison compare(const Model& model, const ExamProtocol& protocol, const ExamTest& test, const ExamSweep& sweep,
                       char side, const ExamEntry* entry, double mass_kg, const SideFit& fit) {
  ExamComparison line;
  line.test = test.id;
  line.side = side;
  line.threshold_Nm = thresholdOf(test, entry, mass_kg);
  const SimulatedTest after = sweep.simulate(line.threshold_Nm, fit.factors);
  line.simulated_before_deg = sweep.simulate(line.threshold_Nm).angle_deg;
  if (fit.outcome == Outcome::Converged) line.simulated_after_deg = after.angle_deg;
  if (entry && entry->measured_deg) {
    line.measured_deg = entry->measured_deg;
    line.residual_deg = *entry->measured_deg - line.simulated_after_deg;
  }
  line.stopped_by_joint = after.stopped_by_joint;
  line.limiting_muscles = after.limiting_muscles;
  line.changed = changesOf(model, protocol, test, side, fit.factors);
  return line;
}

/// A measurement that no choice of lengths could meet: said, not left to be found in a table.
void warnIfUnmet(const ExamTest& test, const ExamComparison& line, Warnings& warnings) {
  if (!line.measured_deg || !(std::abs(line.residual_deg) > test.measurement_sd_deg)) return;
  char text[96];
  std::snprintf(text, sizeof text, " (%s): measured %.0f deg, the fitted model gives %.0f deg%s",
                line.side == 'r' ? "right" : "left", *line.measured_deg, line.simulated_after_deg,
                line.stopped_by_joint ? " (the joint's own stop)" : "");
  warnings.push_back({"exam_not_met", test.title + text + "; muscle lengths alone cannot explain it"});
}

/// Solves one side and appends its lines to the result.
void applySide(const Model& model, const PhysicalExam& exam, const ExamProtocol& protocol, double mass_kg, char side,
               const Job& job, ExamFit& result) {
  const double from = side == 'r' ? 0 : 0.5;
  const std::vector<ExamSweep> sweeps = sweepsOf(model, protocol, side, job, from);
  if (job.cancelled()) {
    result.outcome = Outcome::Cancelled;
    return;
  }
  std::vector<MeasuredTest> measured;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const ExamTest& test = protocol.tests[i];
    const ExamEntry* entry = entryOf(exam, test.id, side);
    if (entry && entry->measured_deg)
      measured.push_back({&test, *entry->measured_deg, thresholdOf(test, entry, mass_kg), sweeps[i]});
  }
  const SideFit fit =
      solveSide(measured, freeGroups(model, protocol, measured, side), side, job, from + 0.2, from + 0.5);
  if (fit.outcome != Outcome::Converged) result.outcome = fit.outcome;
  for (const auto& [unit, factor] : fit.factors) {
    const std::string& name = model.musculature.units[unit].name;
    if (std::abs(factor - 1) > kUnchanged) result.length_factors[name] = factor;
    if (factor < kLeastFactor + 1e-3 || factor > kMostFactor - 1e-3)
      result.warnings.push_back({"length_factor_at_bound", name +
                                                               ": length factor at its bound; muscle lengths alone "
                                                               "cannot meet this examination"});
  }
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const ExamTest& test = protocol.tests[i];
    result.tests.push_back(
        compare(model, protocol, test, sweeps[i], side, entryOf(exam, test.id, side), mass_kg, fit));
    if (fit.outcome == Outcome::Converged) warnIfUnmet(test, result.tests.back(), result.warnings);
  }
}

}  // namespace

ExamFit applyExam(const Model& model, const PhysicalExam& exam, const ExamProtocol& protocol, double mass_kg,
                  const Job& job) {
  const auto start = std::chrono::steady_clock::now();
  if (!(mass_kg > 0)) throw InputError{{"exam", "mass_kg", "a number > 0", std::to_string(mass_kg)}};
  ExamFit result;
  result.warnings = checkExam(exam, protocol);
  result.outcome = Outcome::Converged;
  for (const char side : {'r', 'l'}) {
    applySide(model, exam, protocol, mass_kg, side, job, result);
    if (result.outcome == Outcome::Cancelled) return {.outcome = Outcome::Cancelled};
  }
  if (result.outcome != Outcome::Converged) result.length_factors.clear();
  job.report(1, "examination met by muscle lengths");
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace sinew
