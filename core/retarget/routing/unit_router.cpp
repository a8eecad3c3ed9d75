#include "core/retarget/routing/unit_router_internal.h"

#include <algorithm>

#include "core/muscle/muscle_path.h"

namespace sinew {
namespace {

constexpr double kFirstPrice_1_m2 = 20;  // of moving points, per energy: a slide of 1 cm costs 0.2 % of it
constexpr int kIterationsARound = 10;
constexpr double kTolerance = 1e-4;  // of the energy

}  // namespace

UnitRouting UnitRouter::operator()(std::size_t i, MusculotendonUnit& unit, const std::stop_token& stop) const {
  const double zero_length_m = pathLength(unit, poses_.atZero());
  Place naive = naivePlace(i, unit);
  UnitProblem problem{naive.anchors, prepared_.curves(i), prepared_.poses(),   poses_,
                      naive.points,  zero_length_m,       prepared_.motions(), options_.weights};
  evaluate(naive, problem);
  UnitRouting result{.unit = unit.name, .start = naive.energy, .end = naive.energy, .outcome = Outcome::Converged};
  if (options_.method == RetargetMethod::Naive) return result;

  Place found = naive;
  if (settle(i, found)) {
    problem.moveTo(found.anchors, found.points);
    evaluate(found, problem);
  }
  // A body in which the unit functions as before leaves nothing to improve beyond rounding.
  constexpr double kNothing = 1e-9;
  if (problem.isFree() && total(found.energy) >= kNothing) {
    const Place start = found;
    if (options_.method == RetargetMethod::Paper) {
      found = descended(i, start, problem, result.iterations, stop);
    } else {
      found = solved(i, start, problem, result.iterations, stop);
      found = inOrder(i, start, found, problem, result.iterations, stop);
    }
    if (found.objective >= start.objective) found = start;
  }
  if (stop.stop_requested()) return {.unit = unit.name, .outcome = Outcome::Cancelled};
  result.end = found.energy;
  result.largest_move_m = largestMove_m(naive, found);
  for (std::size_t p = 0; p < unit.path.size(); ++p) unit.path[p].anchors = found.anchors[p];
  return result;
}

UnitRouter::Place UnitRouter::descended(std::size_t i, const Place& start, UnitProblem& problem, int& iterations,
                                        const std::stop_token& stop) const {
  const Minimum found =
      descent(problem, Eigen::VectorXd::Zero(problem.unknowns()), {.finite_differences = true}, stop);
  iterations = found.iterations;
  return moved(i, start, found.x, problem);
}

/// From where the points are, and from where a few steps down the gradient lead: argmax may jump, and then either
/// start gets stuck now and then.
Minimum UnitRouter::bestOfStarts(const UnitProblem& problem, double slide_1_m2, const std::stop_token& stop) const {
  constexpr int kMostIterations = 8, kDescent = 8;
  constexpr double kCoarse = 1e-2, kWorthAnotherStart = 1;
  const Objective objective{.slide_1_m2 = slide_1_m2};
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(problem.unknowns());
  Minimum best = leastSquares(problem, objective, start, kMostIterations, kCoarse, stop);
  if (best.energy > kWorthAnotherStart) {
    const Minimum descended = descent(problem, start, {.most_iterations = kDescent}, stop);
    Minimum second = leastSquares(problem, objective, descended.x, kMostIterations, kCoarse, stop);
    const int iterations = best.iterations + descended.iterations + second.iterations;
    if (second.energy < best.energy) best = std::move(second);
    best.iterations = iterations;
  }
  return best;
}

/// `start` is settled, and so is the result. On the way attachments are where the field carries them; if that is off
/// the surface somewhere, they are put onto it and the search goes on from there, and once more from the start.
UnitRouter::Place UnitRouter::solved(std::size_t i, const Place& start, UnitProblem& problem, int& iterations,
                                     const std::stop_token& stop) const {
  const bool slides = std::ranges::any_of(start.points, &UnitProblem::Point::slides);
  const auto price_1_m2 = [&](const Place& place) { return slides ? kFirstPrice_1_m2 * place.objective : 0; };
  Place place = start;
  place.settled = false;
  place =
      rounds(i, place, bestOfStarts(problem, price_1_m2(start), stop), price_1_m2(start), problem, iterations, stop);
  if (!settle(i, place)) return place;
  Place best = start;
  bool found = false;
  for (const Place& from : {place, start}) {
    if (!from.fits) continue;
    Place next = from;
    problem.moveTo(next.anchors, next.points);
    evaluate(next, problem);
    const double slide_1_m2 = price_1_m2(next);
    next = rounds(i, next, bestOfStarts(problem, slide_1_m2, stop), slide_1_m2, problem, iterations, stop);
    if (!found || next.objective < best.objective) best = std::move(next);
    found = true;
  }
  return best;
}

/// Minimised once more from a place.
UnitRouter::Place UnitRouter::onwards(std::size_t i, const Place& from, Objective objective, UnitProblem& problem,
                                      int& iterations, const std::stop_token& stop) const {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.unknowns());
  const Minimum step = leastSquares(problem, objective, zero, kIterationsARound, kTolerance, stop);
  iterations += step.iterations;
  Place next = moved(i, from, step.x, problem);
  if (next.fits && next.objective < from.objective) return next;
  problem.moveTo(from.anchors, from.points);
  return from;
}

/// Rounds of: minimise as if bones were flat, then slide. What has become of the energy decides whether to go there,
/// and at what price the next round may slide. Once, a place that is worse is given another chance: points that were
/// put out of a bone may be right but for what lies next to them. `step`: the first minimum.
UnitRouter::Place UnitRouter::rounds(std::size_t i, const Place& start, Minimum step, double slide_1_m2,
                                     UnitProblem& problem, int& iterations, const std::stop_token& stop) const {
  constexpr int kMostRounds = 8;
  constexpr double kLastTolerance = 1e-6;        // of the energy, where nothing slides
  constexpr double kGood = 0.75, kPoor = 0.25;   // of what was hoped for
  constexpr double kFarther = 0.2, kNearer = 8;  // factors on the price
  const bool slides = slide_1_m2 > 0;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.unknowns());
  double via_1_m2 = 0;
  bool corrected = false;
  Place place = start;
  for (int round = 0; round < kMostRounds && !stop.stop_requested(); ++round) {
    iterations += step.iterations;
    const double before = place.objective;
    Place candidate = moved(i, place, step.x, problem);
    const double hoped = before - step.energy;
    if (candidate.fits && candidate.objective >= before && !corrected) {
      candidate = onwards(i, candidate, {slide_1_m2, via_1_m2}, problem, iterations, stop);
      corrected = true;
    }
    const double gained = before - candidate.objective;
    const bool little = std::max(hoped, gained) < kTolerance * before;
    const bool fits = candidate.fits || !place.fits;
    if (fits && (gained > 0 || !place.fits))
      place = std::move(candidate);
    else
      problem.moveTo(place.anchors, place.points);
    if (!slides ? round > 0 : little) break;
    if (fits && gained > kGood * hoped) slide_1_m2 *= kFarther, via_1_m2 *= kFarther;
    if (!fits || gained < kPoor * hoped) {
      slide_1_m2 *= kNearer;
      if (!fits || gained <= 0) via_1_m2 = std::max(kNearer * via_1_m2, kFirstPrice_1_m2 * place.objective);
    }
    step = leastSquares(problem, {slide_1_m2, via_1_m2}, zero, kIterationsARound,
                        slides ? kTolerance : kLastTolerance, stop);
    if (step.energy >= place.objective) break;
  }
  return place;
}

}  // namespace sinew
