#include "core/retarget/unit_router_internal.h"

#include <algorithm>

#include "core/muscle/muscle_path.h"
#include "core/skeleton/bone_field.h"
#include "core/skeleton/field_derivatives.h"

namespace sinew {
namespace {

constexpr double kLeastClearance_m = 0.002;  // what a via point keeps from its bone, if it had as much

}  // namespace

UnitRouting UnitRouter::operator()(std::size_t i, MusculotendonUnit& unit, const std::stop_token& stop) const {
  const double zero_length_m = pathLength(unit, poses_.atZero());
  Place naive;
  for (std::size_t p = 0; p < unit.path.size(); ++p) {
    naive.anchors.push_back(unit.path[p].anchors);
    naive.points.push_back(pointOf(i, p, unit.path[p]));
  }
  UnitProblem problem{naive.anchors, prepared_.curves(i), prepared_.poses(),   poses_,
                      naive.points,  zero_length_m,       prepared_.motions(), options_.weights};
  naive.energy = problem.parts(Eigen::VectorXd::Zero(problem.unknowns()));

  UnitRouting result{.unit = unit.name, .start = naive.energy, .end = naive.energy, .outcome = Outcome::Converged};
  // A body in which the unit functions as before leaves nothing to improve beyond rounding.
  constexpr double kNothing = 1e-9;
  if (!problem.isFree() || options_.method == RetargetMethod::Naive || total(naive.energy) < kNothing) return result;

  const Place found = options_.method == RetargetMethod::Paper ? descended(i, naive, problem, result.iterations, stop)
                                                               : solved(i, naive, problem, result.iterations, stop);
  if (stop.stop_requested()) return {.unit = unit.name, .outcome = Outcome::Cancelled};
  if (total(found.energy) >= total(naive.energy)) return result;
  result.end = found.energy;
  result.largest_move_m = largestMove_m(naive, found);
  for (std::size_t p = 0; p < unit.path.size(); ++p) unit.path[p].anchors = found.anchors[p];
  return result;
}

UnitProblem::Point UnitRouter::pointOf(std::size_t unit, std::size_t p, const PathPoint& naive) const {
  const PointGuide& guide = prepared_.guides(unit)[p];
  const Anchor& anchor =
      reference_.musculature.units[unit].path[p].anchors[static_cast<std::size_t>(guide.heaviest_anchor)];
  UnitProblem::Point point;
  point.price_1_m2 = guide.attachment ? options_.weights.attachment_1_m2 : options_.weights.via_1_m2;
  setBasis(anchor, anchor.p_B, guide.basis_B, point);
  point.slides = guide.attachment && !guide.basis_B.isZero(0);
  if (!guide.attachment && guide.surface_segment >= 0) setGuard(unit, p, naive.anchors, point);
  return point;
}

/// Displacements of `anchor`, from p_B in the reference.
void UnitRouter::setBasis(const Anchor& anchor, const Eigen::Vector3d& p_B, const Eigen::Matrix3d& basis_B,
                          UnitProblem::Point& point) const {
  point.basis_B = basis_B;
  if (basis_B.isZero(0)) return;
  point.basis_W = poses_.atZero()[static_cast<std::size_t>(anchor.segment)].linear() *
                  (fieldJacobian(reference_.skeleton, shape_, anchor.segment, p_B) * basis_B);
}

/// The bone that a via point glides on, where it is nearest now. Clearances are measured in the reference, where the
/// point is displaced by moved_B; the surface there is carried over.
void UnitRouter::setGuard(std::size_t unit, std::size_t p, const std::vector<Anchor>& anchors,
                          UnitProblem::Point& point) const {
  const PointGuide& guide = prepared_.guides(unit)[p];
  const auto& reference_anchors = reference_.musculature.units[unit].path[p].anchors;
  const auto on_bone = std::ranges::find(reference_anchors, guide.surface_segment, &Anchor::segment);
  const auto surface_segment = static_cast<std::size_t>(guide.surface_segment);
  const auto moved_in =
      static_cast<std::size_t>(reference_anchors[static_cast<std::size_t>(guide.heaviest_anchor)].segment);
  double clearance_m = guide.clearance_m;
  Eigen::Vector3d surface_B = guide.surface_B;
  if (!point.moved_B.isZero(0)) {
    const auto& zero = prepared_.poses().atZero();
    const Eigen::Vector3d p_B =
        on_bone->p_B + zero[surface_segment].linear().transpose() * (zero[moved_in].linear() * point.moved_B);
    const auto nearest = prepared_.bones().bones()[static_cast<std::size_t>(guide.bone)].distance.nearest(p_B);
    clearance_m = nearest.distance_m;
    surface_B = nearest.point;
  }
  const auto& X_WB = poses_.atZero();
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  for (const Anchor& a : anchors) p_W += a.weight * (X_WB[static_cast<std::size_t>(a.segment)] * a.p_B);
  const Eigen::Vector3d surface_W =
      X_WB[surface_segment] * deform(reference_.skeleton, shape_, guide.surface_segment, surface_B);
  const Eigen::Vector3d away_W = (p_W - surface_W) * (clearance_m < 0 ? -1 : 1);
  if (away_W.norm() < 1e-6) return;
  point.outward_W = away_W.normalized();
  // What lay inside in the reference may stay as deep as it is.
  point.slack_m = 0;
  if (guide.clearance_m > 0)
    point.slack_m =
        (clearance_m < 0 ? -away_W.norm() : away_W.norm()) - std::min(guide.clearance_m, kLeastClearance_m);
  if (point.moved_B.isZero(0)) point.slack_m = std::max(0.0, point.slack_m);
}

/// `from` with its points displaced by x. A via point is displaced in the new body; an attachment slides on the
/// bone of the reference and is then carried by the field. `problem` moves with it.
UnitRouter::Place UnitRouter::moved(std::size_t i, const Place& from, const Eigen::VectorXd& x,
                                    UnitProblem& problem) const {
  Place to = from;
  for (std::size_t p = 0; p < from.points.size(); ++p) {
    const Eigen::Vector3d step = x.segment<3>(static_cast<Eigen::Index>(3 * p));
    const UnitProblem::Point& before = from.points[p];
    if (before.basis_B.isZero(0) || step.isZero(0)) continue;
    UnitProblem::Point& point = to.points[p];
    std::vector<Anchor>& anchors = to.anchors[p];
    point.moved_B += before.basis_B * step;
    if (prepared_.guides(i)[p].attachment) {
      slide(i, p, point, anchors.front());
    } else {
      const Eigen::Vector3d d_W = before.basis_W * step;
      point.slack_m += before.outward_W.dot(d_W);
      for (Anchor& anchor : anchors)
        anchor.p_B += poses_.atZero()[static_cast<std::size_t>(anchor.segment)].linear().transpose() * d_W;
      constexpr double kFlat_m = 0.001;  // for so far a bone is taken for flat
      if (prepared_.guides(i)[p].surface_segment >= 0 && d_W.norm() > kFlat_m) setGuard(i, p, anchors, point);
    }
    problem.movePoint(p, anchors, point);
  }
  to.energy = problem.parts(Eigen::VectorXd::Zero(problem.unknowns()));
  return to;
}

/// Back to the surface of its bone, at the distance that it had.
void UnitRouter::slide(std::size_t unit, std::size_t p, UnitProblem::Point& point, Anchor& anchor) const {
  const PointGuide& guide = prepared_.guides(unit)[p];
  const Eigen::Vector3d before_B = reference_.musculature.units[unit].path[p].anchors.front().p_B;
  const auto surface =
      prepared_.bones().bones()[static_cast<std::size_t>(guide.bone)].distance.nearest(before_B + point.moved_B);
  const Eigen::Vector3d p_B = surface.point + guide.clearance_m * surface.normal;
  point.moved_B = p_B - before_B;
  anchor.p_B = deform(reference_.skeleton, shape_, anchor.segment, p_B);
  setBasis(anchor, p_B, tangentBasis(surface.normal), point);
}

UnitRouter::Place UnitRouter::descended(std::size_t i, const Place& naive, UnitProblem& problem, int& iterations,
                                        const std::stop_token& stop) const {
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(problem.unknowns());
  const Minimum found = descent(problem, start, {.finite_differences = true}, stop);
  iterations = found.iterations;
  return moved(i, naive, found.x, problem);
}

/// From where the points are, and from where a few steps down the gradient lead: argmax may jump, and then either
/// start gets stuck now and then.
Minimum UnitRouter::bestOfStarts(const UnitProblem& problem, double slide_1_m2, const std::stop_token& stop) const {
  constexpr int kMostIterations = 8, kDescent = 8;
  constexpr double kTolerance = 1e-2, kWorthAnotherStart = 1;
  const Objective objective{.slide_1_m2 = slide_1_m2};
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(problem.unknowns());
  Minimum best = leastSquares(problem, objective, start, kMostIterations, kTolerance, stop);
  if (best.energy > kWorthAnotherStart) {
    const Minimum descended = descent(problem, start, {.most_iterations = kDescent}, stop);
    Minimum second = leastSquares(problem, objective, descended.x, kMostIterations, kTolerance, stop);
    const int iterations = best.iterations + descended.iterations + second.iterations;
    if (second.energy < best.energy) best = std::move(second);
    best.iterations = iterations;
  }
  return best;
}

/// Rounds of: minimise as if bones were flat, then slide. What has become of the energy decides whether to go there,
/// and at what price the next round may slide.
UnitRouter::Place UnitRouter::solved(std::size_t i, const Place& naive, UnitProblem& problem, int& iterations,
                                     const std::stop_token& stop) const {
  constexpr int kMostRounds = 8, kMostIterations = 10;
  constexpr double kTolerance = 1e-4, kLastTolerance = 1e-6;  // of the energy
  constexpr double kGood = 0.75, kPoor = 0.25;                // of what was hoped for
  constexpr double kFarther = 0.2, kNearer = 8;               // factors on the price
  constexpr double kFirstPrice_1_m2 = 20;                     // of the energy: a slide of 1 cm costs 0.2 % of it
  const bool slides = std::ranges::any_of(naive.points, &UnitProblem::Point::slides);
  double slide_1_m2 = slides ? kFirstPrice_1_m2 * total(naive.energy) : 0;
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(problem.unknowns());
  Place place = naive;
  Minimum step = bestOfStarts(problem, slide_1_m2, stop);
  for (int round = 0; round < kMostRounds && !stop.stop_requested(); ++round) {
    iterations += step.iterations;
    const double before = total(place.energy);
    Place candidate = moved(i, place, step.x, problem);
    const double hoped = before - step.energy, gained = before - total(candidate.energy);
    const bool little = std::max(hoped, gained) < kTolerance * before;
    if (gained > 0)
      place = std::move(candidate);
    else
      problem.moveTo(place.anchors, place.points);
    if (!slides ? round > 0 : little) break;
    if (gained > kGood * hoped) slide_1_m2 *= kFarther;
    if (gained < kPoor * hoped) slide_1_m2 *= kNearer;
    step = leastSquares(problem, {.slide_1_m2 = slide_1_m2}, start, kMostIterations,
                        slides ? kTolerance : kLastTolerance, stop);
    if (step.energy >= total(place.energy)) break;
  }
  return place;
}

double UnitRouter::largestMove_m(const Place& before, const Place& after) const {
  const auto at = [&](const std::vector<Anchor>& anchors) {
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
    for (const Anchor& a : anchors) p_W += a.weight * (poses_.atZero()[static_cast<std::size_t>(a.segment)] * a.p_B);
    return p_W;
  };
  double largest_m = 0;
  for (std::size_t p = 0; p < before.anchors.size(); ++p)
    largest_m = std::max(largest_m, (at(after.anchors[p]) - at(before.anchors[p])).norm());
  return largest_m;
}

}  // namespace sinew
