#include "core/retarget/routing.h"

#include <algorithm>

#include "core/muscle/muscle_path.h"
#include "core/parallel.h"
#include "core/retarget/minimize_internal.h"
#include "core/retarget/routing_reference.h"
#include "core/skeleton/bone_field.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kLeastClearance_m = 0.002;  // what a via point keeps from its bone, if it had as much

/// How the field carries a small displacement d_B of a point: forward over 2 h.
Eigen::Vector3d carried(const Skeleton& reference, const std::vector<double>& shape, int segment,
                        const Eigen::Vector3d& p_B, const Eigen::Vector3d& d_B) {
  constexpr double kStep = 1e-4;
  return (deform(reference, shape, segment, Eigen::Vector3d{p_B + kStep * d_B}) -
          deform(reference, shape, segment, Eigen::Vector3d{p_B - kStep * d_B})) /
         (2 * kStep);
}

/// One unit in its new body. Its points are displaced in the reference and carried over by the field.
class UnitRouter {
 public:
  UnitRouter(const Model& reference, const RoutingReference& prepared, const std::vector<double>& shape,
             const MotionPoses& poses, const RoutingOptions& options)
      : reference_{reference}, prepared_{prepared}, shape_{shape}, poses_{poses}, options_{options} {}

  /// Moves the points of `unit`, the i-th of the model.
  UnitRouting operator()(std::size_t i, MusculotendonUnit& unit, const std::stop_token& stop) const {
    const double zero_length_m = pathLength(unit, poses_.atZero());
    Place naive{unit, std::vector<UnitProblem::Point>(unit.path.size()), {}};
    for (std::size_t p = 0; p < unit.path.size(); ++p) naive.points[p] = pointOf(i, p, unit.path[p]);
    UnitProblem problem{unit,         prepared_.curves(i), prepared_.poses(),   poses_,
                        naive.points, zero_length_m,       prepared_.motions(), options_.weights};
    naive.energy = problem.parts(Eigen::VectorXd::Zero(problem.unknowns()));

    UnitRouting result{.unit = unit.name, .start = naive.energy, .end = naive.energy, .outcome = Outcome::Converged};
    // A body in which the unit functions as before leaves nothing to improve beyond rounding.
    constexpr double kNothing = 1e-9;
    if (!problem.isFree() || options_.method == RetargetMethod::Naive ||
        naive.energy.total(options_.weights) < kNothing)
      return result;

    const Place found = options_.method == RetargetMethod::Paper
                            ? descended(i, naive, problem, result.iterations, stop)
                            : solved(i, naive, problem, result.iterations, stop);
    if (stop.stop_requested()) return {.unit = unit.name, .outcome = Outcome::Cancelled};
    if (found.energy.total(options_.weights) >= naive.energy.total(options_.weights)) return result;
    result.end = found.energy;
    result.largest_move_m = largestMove_m(unit, found.unit);
    unit = found.unit;
    return result;
  }

 private:
  /// A unit with the directions in which its points can move on from there.
  struct Place {
    MusculotendonUnit unit;
    std::vector<UnitProblem::Point> points;
    RoutingEnergy energy;
  };

  UnitProblem::Point pointOf(std::size_t unit, std::size_t p, const PathPoint& naive) const {
    const PointGuide& guide = prepared_.guides(unit)[p];
    const Anchor& anchor =
        reference_.musculature.units[unit].path[p].anchors[static_cast<std::size_t>(guide.heaviest_anchor)];
    UnitProblem::Point point;
    point.price_1_m2 = guide.attachment ? options_.weights.attachment_1_m2 : options_.weights.via_1_m2;
    setBasis(anchor, anchor.p_B, guide.basis_B, point);
    if (!guide.attachment && guide.surface_segment >= 0) setGuard(guide, naive, point);
    return point;
  }

  /// Displacements of `anchor`, from p_B in the reference.
  void setBasis(const Anchor& anchor, const Eigen::Vector3d& p_B, const Eigen::Matrix3d& basis_B,
                UnitProblem::Point& point) const {
    point.basis_B = basis_B;
    for (int k = 0; k < 3; ++k)
      if (!basis_B.col(k).isZero(0))
        point.basis_W.col(k) = poses_.atZero()[static_cast<std::size_t>(anchor.segment)].linear() *
                               carried(reference_.skeleton, shape_, anchor.segment, p_B, basis_B.col(k));
  }

  void setGuard(const PointGuide& guide, const PathPoint& naive, UnitProblem::Point& point) const {
    const auto& X_WB = poses_.atZero();
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
    for (const Anchor& a : naive.anchors) p_W += a.weight * (X_WB[static_cast<std::size_t>(a.segment)] * a.p_B);
    const Eigen::Vector3d surface_W = X_WB[static_cast<std::size_t>(guide.surface_segment)] *
                                      deform(reference_.skeleton, shape_, guide.surface_segment, guide.surface_B);
    const Eigen::Vector3d away_W = (p_W - surface_W) * (guide.clearance_m < 0 ? -1 : 1);
    if (away_W.norm() < 1e-6) return;
    point.outward_W = away_W.normalized();
    if (guide.clearance_m > 0)
      point.slack_m = std::max(0.0, away_W.norm() - std::min(guide.clearance_m, kLeastClearance_m));
  }

  /// `from` with its points displaced by x. A via point is displaced in the new body; an attachment slides on the
  /// bone of the reference and is then carried by the field. `problem` moves with it.
  Place moved(std::size_t i, const Place& from, const Eigen::VectorXd& x, UnitProblem& problem) const {
    Place to = from;
    for (std::size_t p = 0; p < from.points.size(); ++p) {
      const Eigen::Vector3d step = x.segment<3>(static_cast<Eigen::Index>(3 * p));
      const UnitProblem::Point& before = from.points[p];
      if (before.basis_B.isZero(0) || step.isZero(0)) continue;
      UnitProblem::Point& point = to.points[p];
      PathPoint& path_point = to.unit.path[p];
      point.moved_B += before.basis_B * step;
      if (prepared_.guides(i)[p].attachment) {
        slide(i, p, point, path_point.anchors.front());
      } else {
        const Eigen::Vector3d d_W = before.basis_W * step;
        point.slack_m += before.outward_W.dot(d_W);
        for (Anchor& anchor : path_point.anchors)
          anchor.p_B += poses_.atZero()[static_cast<std::size_t>(anchor.segment)].linear().transpose() * d_W;
      }
    }
    problem.moveTo(to.unit, to.points);
    to.energy = problem.parts(Eigen::VectorXd::Zero(problem.unknowns()));
    return to;
  }

  /// Back to the surface of its bone, at the distance that it had.
  void slide(std::size_t unit, std::size_t p, UnitProblem::Point& point, Anchor& anchor) const {
    const PointGuide& guide = prepared_.guides(unit)[p];
    const Eigen::Vector3d before_B = reference_.musculature.units[unit].path[p].anchors.front().p_B;
    const auto surface =
        prepared_.bones().bones()[static_cast<std::size_t>(guide.bone)].distance.nearest(before_B + point.moved_B);
    const Eigen::Vector3d p_B = surface.point + guide.clearance_m * surface.normal;
    point.moved_B = p_B - before_B;
    anchor.p_B = deform(reference_.skeleton, shape_, anchor.segment, p_B);
    setBasis(anchor, p_B, tangentBasis(surface.normal), point);
  }

  Place descended(std::size_t i, const Place& naive, UnitProblem& problem, int& iterations,
                  const std::stop_token& stop) const {
    const Eigen::VectorXd start = Eigen::VectorXd::Zero(problem.unknowns());
    const Minimum found = descent(problem, start, {.finite_differences = true}, stop);
    iterations = found.iterations;
    return moved(i, naive, found.x, problem);
  }

  /// The curve's shape leads into the basin; the paper's energy, whose extrema may jump, decides. Several starts,
  /// because either gets stuck now and then; a second round from the place found, where bones are no longer flat.
  Place solved(std::size_t i, const Place& naive, UnitProblem& problem, int& iterations,
               const std::stop_token& stop) const {
    const Eigen::VectorXd start = Eigen::VectorXd::Zero(problem.unknowns());
    Minimum best{start, naive.energy.total(options_.weights)};
    const auto refine = [&](const Minimum& from) {
      const Minimum found = leastSquares(problem, {}, from.x, 25, 1e-3, stop);
      iterations += from.iterations + found.iterations;
      if (found.energy < best.energy) best = found;
    };
    refine(leastSquares(problem, {.features = false}, start, 5, 1e-1, stop));
    refine(Minimum{start});
    constexpr double kWorthAnotherStart = 1;
    if (best.energy > kWorthAnotherStart) refine(descent(problem, start, {.most_iterations = 8}, stop));
    const Place place = moved(i, naive, best.x, problem);
    const Minimum last = leastSquares(problem, {}, start, 15, 1e-6, stop);
    iterations += last.iterations;
    const Place settled = moved(i, place, last.x, problem);
    return settled.energy.total(options_.weights) < place.energy.total(options_.weights) ? settled : place;
  }

  double largestMove_m(const MusculotendonUnit& before, const MusculotendonUnit& after) const {
    const auto from = pathPoints(before, poses_.atZero()), to = pathPoints(after, poses_.atZero());
    double largest_m = 0;
    for (std::size_t p = 0; p < from.size(); ++p) largest_m = std::max(largest_m, (to[p] - from[p]).norm());
    return largest_m;
  }

  const Model& reference_;
  const RoutingReference& prepared_;
  const std::vector<double>& shape_;
  const MotionPoses& poses_;
  const RoutingOptions& options_;
};

void mirrorPath(const MusculotendonUnit& right, MusculotendonUnit& left) {
  for (std::size_t p = 0; p < right.path.size(); ++p)
    for (std::size_t k = 0; k < right.path[p].anchors.size(); ++k)
      left.path[p].anchors[k].p_B = mirrored(right.path[p].anchors[k].p_B);
}

}  // namespace

std::string_view nameOf(RetargetMethod method) {
  return method == RetargetMethod::Naive ? "naive" : method == RetargetMethod::Paper ? "paper" : "sinew";
}

RetargetMethod retargetMethodNamed(std::string_view name) {
  for (const RetargetMethod method : {RetargetMethod::Naive, RetargetMethod::Paper, RetargetMethod::Sinew})
    if (name == nameOf(method)) return method;
  throw InputError{
      {"retargeting", "method", "sinew, paper or naive",
       "'" + std::string{name} + "'" + didYouMean(name, std::vector<std::string>{"sinew", "paper", "naive"})}};
}

Routing route(const Model& reference, const RoutingReference& prepared, Model& model, const RoutingOptions& options,
              const Job& job) {
  require(reference.musculature.units.size() == model.musculature.units.size(), "route: the same units");
  const std::vector<double> shape = toVector(model.shape);
  const MotionPoses poses{model.skeleton, prepared.motions()};
  const UnitRouter router{reference, prepared, shape, poses, options};
  const bool symmetric = model.shape.sides[0] == model.shape.sides[1];
  const auto mirrorBefore = [&](std::size_t i) {
    const int mirror = prepared.mirrorOf()[i];
    return symmetric && mirror >= 0 && static_cast<std::size_t>(mirror) < i ? mirror : -1;
  };

  std::vector<MusculotendonUnit> units = model.musculature.units;
  Routing routing{.units = std::vector<UnitRouting>(units.size())};
  const bool done = forEachInParallel(units.size(), job, "routing", [&](std::size_t i) {
    if (mirrorBefore(i) < 0) routing.units[i] = router(i, units[i], job.stop);
  });
  if (!done) return {.outcome = Outcome::Cancelled};
  for (std::size_t i = 0; i < units.size(); ++i)
    if (const int mirror = mirrorBefore(i); mirror >= 0) {
      routing.units[i] = routing.units[static_cast<std::size_t>(mirror)];
      routing.units[i].unit = units[i].name;
      mirrorPath(units[static_cast<std::size_t>(mirror)], units[i]);
    }
  model.musculature.units = std::move(units);
  routing.outcome = Outcome::Converged;
  return routing;
}

}  // namespace sinew
