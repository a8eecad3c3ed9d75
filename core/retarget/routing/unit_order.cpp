#include <algorithm>
#include <utility>

#include "core/retarget/routing/unit_router_internal.h"

// What UnitRouter does about steps of length-angle curves that go the other way than in the reference.

namespace sinew {

/// Over the motions that the unit is significant in; `reversed`, if asked for: which.
StepCount UnitRouter::reversals(std::size_t i, const Place& place,
                                std::vector<UnitProblem::WatchedStep>* reversed) const {
  const ReferenceCurves& curves = prepared_.curves(i);
  MusculotendonUnit unit{.path = reference_.musculature.units[i].path};
  for (std::size_t p = 0; p < unit.path.size(); ++p) unit.path[p].anchors = place.anchors[p];
  StepCount count;
  for (std::size_t m = 0; m < curves.motions.size(); ++m) {
    const std::vector<int>& directions = curves.step_directions[m];
    if (directions.empty()) continue;
    const int before = count.reversed;
    const std::vector<double> lengths_m = lengthsOver(unit, poses_.over(curves.motions[m]));
    countReversals(directions, lengths_m, count);
    if (!reversed || count.reversed == before) continue;
    for (std::size_t s = 0; s < directions.size(); ++s)
      if (directions[s] * (lengths_m[s + 1] - lengths_m[s]) < 0)
        reversed->push_back({.motion = m, .step = s, .direction = double(directions[s])});
  }
  return count;
}

/// Minimised from a place with a price on the steps that are found reversed, higher and higher until there are no
/// more than allowed. `watched`: steps known to be in danger, to which those are added. `fits` tells whether that was
/// reached.
UnitRouter::Place UnitRouter::watchedFrom(std::size_t i, const Place& from, int allowed, double first_weight,
                                          std::vector<UnitProblem::WatchedStep>& watched, UnitProblem& problem,
                                          int& iterations, const std::stop_token& stop) const {
  constexpr int kMostPrices = 5;
  constexpr double kLeastStep = 0.005;  // of the reference's
  constexpr double kDearer = 20;
  const ReferenceCurves& curves = prepared_.curves(i);
  Place place = from;
  double weight = first_weight;
  for (int price = 0; price < kMostPrices && !stop.stop_requested(); ++price, weight *= kDearer) {
    std::vector<UnitProblem::WatchedStep> reversed;
    const bool ordered = reversals(i, place, &reversed).reversed <= allowed;
    if (ordered && price > 0) break;
    for (const UnitProblem::WatchedStep& step : reversed)
      if (std::ranges::none_of(watched,
                               [&](const auto& w) { return w.motion == step.motion && w.step == step.step; }))
        watched.push_back(step);
    for (UnitProblem::WatchedStep& step : watched) {
      const auto& lengths = curves.step_lengths[step.motion];
      const double wanted = lengths[step.step + 1] - lengths[step.step];
      step.least = kLeastStep * std::abs(wanted);
      step.weight = weight / (wanted * wanted);
    }
    problem.moveTo(place.anchors, place.points);
    problem.watch(watched, place.anchors);
    evaluate(place, problem);
    place = solved(i, place, problem, iterations, stop);
  }
  place.fits = place.fits && reversals(i, place, nullptr).reversed <= allowed;
  problem.watch({}, place.anchors);
  place.objective = total(place.energy);
  return place;
}

/// A share of the way from one place to another.
UnitRouter::Place UnitRouter::between(std::size_t i, const Place& from, const Place& to, double share,
                                      UnitProblem& problem) const {
  Eigen::VectorXd x{problem.unknowns()};
  for (std::size_t p = 0; p < from.points.size(); ++p)
    x.segment<3>(static_cast<Eigen::Index>(3 * p)) =
        share * from.points[p].basis_B.transpose() * (to.points[p].moved_B - from.points[p].moved_B);
  problem.moveTo(from.anchors, from.points);
  return moved(i, from, x, problem);
}

/// `found` if no more of its steps are reversed than of `start`'s. Else the lowest in energy of what keeps to that:
/// minimised anew from either place with a price on the steps that are reversed, or from as far on the line between
/// them as can be: it may be all of another basin. Fewer are taken if they cost little.
UnitRouter::Place UnitRouter::inOrder(std::size_t i, const Place& start, const Place& found, UnitProblem& problem,
                                      int& iterations, const std::stop_token& stop) const {
  constexpr double kLittle = 1.01;
  constexpr double kFirstWeight = 10, kFirstWeightInOrder = 200;  // of a step that lacks all of its length
  const int now = reversals(i, found, nullptr).reversed;
  if (now == 0) return found;
  const int before = reversals(i, start, nullptr).reversed, allowed = std::min(now - 1, before);
  const bool must = now > before;
  Place best = must ? start : found;
  std::vector<UnitProblem::WatchedStep> watched;
  for (const Place* from : {&found, &start}) {
    Place place = watchedFrom(i, *from, allowed, kFirstWeight, watched, problem, iterations, stop);
    const double most = must ? best.objective : kLittle * found.objective;
    if (place.fits && place.objective < most) best = std::move(place);
    if (best.objective < kLittle * found.objective) return best;
  }
  constexpr int kParts = 10;  // of the line
  for (int part = kParts - 1; must && part > 0; --part) {
    Place place = between(i, start, found, double(part) / kParts, problem);
    if (!place.fits || reversals(i, place, nullptr).reversed > allowed) continue;
    Place next = watchedFrom(i, place, allowed, kFirstWeightInOrder, watched, problem, iterations, stop);
    for (Place* candidate : {&place, &next})
      if (candidate->fits && candidate->objective < best.objective) best = std::move(*candidate);
    break;
  }
  return best;
}

}  // namespace sinew
