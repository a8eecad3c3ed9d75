#include "app/experiments/method_comparison.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <utility>

#include "app/experiments/disorders.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

class MethodClock {
 public:
  MethodTime read() const {
    return {double(std::clock() - cpu_) / CLOCKS_PER_SEC,
            std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count()};
  }

 private:
  std::clock_t cpu_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

struct Routed {
  std::vector<UnitRouting> units;
  MethodTime time;
  std::vector<double> reversed;
};

/// Empty if cancelled.
Routed routed(const RetargetReference& reference, const Model& naive, RetargetMethod method, const Job& job) {
  Model model = naive;
  const MethodClock clock;
  Routing routing = route(reference.model(), reference.routing(), model, {.method = method}, {.stop = job.stop});
  const MethodTime time = clock.read();
  return {std::move(routing.units), time, reversalShares(reference, model, kReversalSteps)};
}

struct Whole {
  PeakTorqueTotals peaks;
  MethodTime time;
};

/// All steps. Of no use if cancelled.
Whole whole(const RetargetReference& reference, const ShapeParameters& shape, RetargetMethod method, const Job& job) {
  const MethodClock clock;
  const Retargeted body = retarget(reference, shape, {.method = method}, {.stop = job.stop});
  const MethodTime time = clock.read();
  return {peakTorqueTotals(body.peak_torque), time};
}

std::vector<double> totals(const std::vector<UnitRouting>& units, RoutingEnergy UnitRouting::*which) {
  std::vector<double> energies;
  for (const UnitRouting& unit : units) energies.push_back((unit.*which).total({}));
  return energies;
}

double paperEnergy(const std::vector<UnitRouting>& units) {
  double sum = 0;
  for (const UnitRouting& unit : units) sum += unit.end.paper({});
  return sum;
}

void judge(const std::vector<std::string>& units, const BodyComparison& body, EnergyVerdict& v) {
  constexpr double kNothing = 1e-9, kRounding = 1e-6;
  for (std::size_t u = 0; u < units.size(); ++u) {
    const double start = body.start[u], paper = body.paper[u], sinew = body.sinew[u];
    v.sum_start += start, v.sum_paper += paper, v.sum_sinew += sinew;
    if (start < kNothing) continue;
    ++v.compared;
    const double difference = sinew - paper;
    const bool equal = std::abs(difference) <= kRounding * start;
    ++(equal ? v.equal : difference < 0 ? v.lower : v.higher);
    v.equal_at_start += equal && start - sinew <= kRounding * start;
    if (difference <= kRounding * start) continue;
    if (sinew > 1.01 * paper) {
      ++v.higher_by_one_percent;
      v.higher_for_order += body.paper_reversed[u] > body.sinew_reversed[u];
    }
    if (sinew / paper > v.worst_ratio) v.worst_ratio = sinew / paper, v.worst_unit = units[u] + ", " + body.name;
  }
}

}  // namespace

MethodComparison compareMethods(const RetargetReference& reference, const std::vector<NamedShape>& shapes,
                                const Job& job) {
  MethodComparison result;
  for (const auto& unit : reference.model().musculature.units) result.units.push_back(unit.name);
  for (const NamedShape& shape : shapes) {
    job.report(double(result.bodies.size()) / double(shapes.size()), "both methods");
    const Model naive = deformedModel(reference.model(), shape.shape);
    const Routed paper = routed(reference, naive, RetargetMethod::Paper, job);
    const Routed sinew = routed(reference, naive, RetargetMethod::Sinew, job);
    const Whole whole_paper = whole(reference, shape.shape, RetargetMethod::Paper, job);
    const Whole whole_sinew = whole(reference, shape.shape, RetargetMethod::Sinew, job);
    if (job.cancelled()) return {.outcome = Outcome::Cancelled};
    result.bodies.push_back({shape.name, totals(sinew.units, &UnitRouting::start),
                             totals(paper.units, &UnitRouting::end), totals(sinew.units, &UnitRouting::end),
                             paper.reversed, sinew.reversed, paperEnergy(paper.units), paperEnergy(sinew.units),
                             paper.time, sinew.time, whole_paper.time, whole_sinew.time, whole_paper.peaks,
                             whole_sinew.peaks});
  }
  result.outcome = Outcome::Converged;
  return result;
}

EnergyVerdict energyVerdict(const std::vector<std::string>& units, const BodyComparison& body) {
  EnergyVerdict verdict;
  judge(units, body, verdict);
  return verdict;
}

EnergyVerdict energyVerdict(const MethodComparison& comparison) {
  EnergyVerdict verdict;
  for (const BodyComparison& body : comparison.bodies) judge(comparison.units, body, verdict);
  return verdict;
}

FunctionKeeping functionKeeping(const RetargetReference& reference, const std::vector<ShapeParameters>& shapes,
                                const Job& job) {
  FunctionKeeping result;
  for (const ShapeParameters& shape : shapes) {
    job.report(double(result.retargeted.size()) / double(shapes.size()), "functions of mild shapes");
    const Retargeted body = retarget(reference, shape, {.peak_torque = false}, {.stop = job.stop});
    if (body.outcome != Outcome::Converged) return {.outcome = body.outcome};
    result.naive.push_back(keptFunctions(reference, deformedModel(reference.model(), shape)));
    result.retargeted.push_back(keptFunctions(reference, body.model));
  }
  result.outcome = Outcome::Converged;
  return result;
}

}  // namespace sinew
