#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "core/retarget/routing/unit_router_internal.h"
#include "core/skeleton/shape/bone_field.h"
#include "core/skeleton/shape/field_derivatives.h"

// Where UnitRouter may put the points of a unit: attachments on the surface of the new body's bones, via points
// outside them.

namespace sinew {
namespace {

constexpr double kLeastClearance_m = 0.002;  // what a via point is to keep from its bone, if it had as much
constexpr double kOutside_m = 0.00005;       // what it keeps from any bone
constexpr double kOnBone_m = 0.0005;         // an attachment is no farther off, unless it was so in the reference
constexpr int kMostSteps = 5;                // out of one bone it may come into the next

}  // namespace

Eigen::Vector3d UnitRouter::atRest(const std::vector<Anchor>& anchors) const {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  for (const Anchor& a : anchors) p_W += a.weight * (poses_.atZero()[static_cast<std::size_t>(a.segment)] * a.p_B);
  return p_W;
}

UnitRouter::Place UnitRouter::naivePlace(std::size_t i, const MusculotendonUnit& unit) const {
  Place place;
  for (std::size_t p = 0; p < unit.path.size(); ++p) {
    place.anchors.push_back(unit.path[p].anchors);
    place.points.push_back(pointOf(i, p, unit.path[p]));
    place.free_m.push_back(0);
  }
  return place;
}

UnitProblem::Point UnitRouter::pointOf(std::size_t unit, std::size_t p, const PathPoint& naive) const {
  const PointGuide& guide = prepared_.guides(unit)[p];
  const Anchor& anchor =
      reference_.musculature.units[unit].path[p].anchors[static_cast<std::size_t>(guide.heaviest_anchor)];
  UnitProblem::Point point;
  point.price_1_m2 = guide.attachment ? options_.weights.attachment_1_m2 : options_.weights.via_1_m2;
  setBasis(anchor, anchor.p_B, guide.basis_B, point);
  point.slides = guide.attachment && !guide.basis_B.isZero(0);
  if (!guide.attachment && guide.bone >= 0) {
    const auto surface_segment = static_cast<std::size_t>(guide.surface_segment);
    const Eigen::Vector3d surface_W = poses_.atZero()[surface_segment] *
                                      deform(reference_.skeleton, shape_, guide.surface_segment, guide.surface_B);
    const Eigen::Vector3d away_W = atRest(naive.anchors) - surface_W;
    if (away_W.norm() < 1e-6) return point;
    point.outward_W = away_W.normalized();
    // Where the field takes it costs nothing.
    if (guide.clearance_m > 0)
      point.slack_m = std::max(0.0, away_W.norm() - std::min(guide.clearance_m, kLeastClearance_m));
  }
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

/// A bone that a via point keeps away from, where it is nearest now; `kept_m`: from the surface, in the reference.
void UnitRouter::setGuard(int bone, double kept_m, const std::vector<Anchor>& anchors,
                          UnitProblem::Point& point) const {
  const RigidTransform& X_WB = poses_.atZero()[static_cast<std::size_t>(bones_.segment(bone))];
  const Eigen::Vector3d p_B = X_WB.inverse() * atRest(anchors);
  const auto surface = bones_[bone].nearest(p_B);
  point.outward_W = X_WB.linear() * surface.outward(p_B);
  // What lay inside in the reference may stay as deep as it is.
  point.slack_m = kept_m > 0 ? surface.distance_m - std::min(kept_m, kLeastClearance_m) : 0;
}

void UnitRouter::displace(const Eigen::Vector3d& d_W, UnitProblem::Point& point, std::vector<Anchor>& anchors) const {
  point.slack_m += point.outward_W.dot(d_W);
  for (Anchor& anchor : anchors)
    anchor.p_B += poses_.atZero()[static_cast<std::size_t>(anchor.segment)].linear().transpose() * d_W;
}

/// Of `bones`, those of one segment (-1: of all), without one of them (-1: with all).
UnitRouter::Inside UnitRouter::nearestOf(const std::vector<int>& bones, int segment, int but,
                                         const Eigen::Vector3d& p_W) const {
  Inside nearest{.distance_m = std::numeric_limits<double>::infinity()};
  for (const int bone : bones) {
    if (bone == but || (segment >= 0 && bones_.segment(bone) != segment)) continue;
    const RigidTransform& X_WB = poses_.atZero()[static_cast<std::size_t>(bones_.segment(bone))];
    const double distance_m = bones_[bone].distanceAtLeast_m(X_WB.inverse() * p_W);
    if (distance_m < nearest.distance_m) nearest = {bone, distance_m};
  }
  return nearest;
}

/// A via point that has come into a bone: onto its surface, by the shortest way; so each of its anchors with the
/// bones of its own segment. Whether all is outside then.
bool UnitRouter::pushOut(const PointGuide& guide, UnitProblem::Point& point, std::vector<Anchor>& anchors,
                         double& free_m) const {
  const auto wayOut = [&](int bone, const Eigen::Vector3d& p_W) -> Eigen::Vector3d {
    const RigidTransform& X_WB = poses_.atZero()[static_cast<std::size_t>(bones_.segment(bone))];
    const auto surface = bones_[bone].nearest(X_WB.inverse() * p_W);
    return X_WB * (surface.point + kOutside_m * surface.normal) - p_W;
  };
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Vector3d p_W = atRest(anchors);
    const Inside whole = nearestOf(guide.near_bones, -1, -1, p_W);
    free_m = whole.distance_m;
    Eigen::Vector3d d_W = Eigen::Vector3d::Zero();
    if (whole.distance_m < 0) displace(d_W = wayOut(whole.bone, p_W), point, anchors);
    for (Anchor& anchor : anchors) {
      if (anchors.size() == 1) break;
      const RigidTransform& X_WB = poses_.atZero()[static_cast<std::size_t>(anchor.segment)];
      const Inside own = nearestOf(guide.near_bones, anchor.segment, -1, X_WB * anchor.p_B);
      free_m = std::min(free_m, own.distance_m);
      if (own.distance_m >= 0) continue;
      const Eigen::Vector3d out_W = wayOut(own.bone, X_WB * anchor.p_B);
      anchor.p_B += X_WB.linear().transpose() * out_W;
      d_W += anchor.weight * out_W;
    }
    if (free_m >= 0) return true;
    point.moved_B += point.basis_B * point.basis_W.lu().solve(d_W);
    setGuard(whole.distance_m < 0 ? whole.bone : guide.bone, guide.clearance_m, anchors, point);
  }
  return false;
}

/// An attachment that the field has carried off the surface of its bone, or into a neighbour: back onto it. Whether
/// it is on a bone then.
bool UnitRouter::putOntoBone(const PointGuide& guide, UnitProblem::Point& point, Anchor& anchor,
                             double& free_m) const {
  constexpr double kRounding_m = 1e-9;
  const double allowed_m = std::max(kOnBone_m, std::abs(guide.clearance_m)) + kRounding_m;
  const double kept_m = std::clamp(guide.clearance_m, -kOnBone_m, kOnBone_m);
  const RigidTransform& X_WB = poses_.atZero()[static_cast<std::size_t>(anchor.segment)];
  const Eigen::Vector3d before_B = anchor.p_B;
  bool on = false;
  for (int step = 0; step < kMostSteps && !on; ++step) {
    auto surface = bones_[guide.bone].nearest(anchor.p_B);
    if (free_m <= 0 || surface.distance_m > allowed_m) {
      const Inside other = nearestOf(guide.near_bones, anchor.segment, guide.bone, X_WB * anchor.p_B);
      free_m = std::max(0.0, other.distance_m);
      if (other.distance_m < std::clamp(surface.distance_m, 0.0, allowed_m)) {
        const auto beside = bones_[other.bone].nearest(anchor.p_B);
        if (beside.distance_m < surface.distance_m) surface = beside;
      }
    }
    on = std::abs(surface.distance_m) <= allowed_m;
    if (on) break;
    const Eigen::Vector3d onto_B = surface.point + kept_m * surface.outward(anchor.p_B);
    free_m -= (onto_B - anchor.p_B).norm();
    anchor.p_B = onto_B;
  }
  if (anchor.p_B != before_B)
    point.moved_B +=
        fieldJacobian(reference_.skeleton, shape_, anchor.segment, anchor.p_B).lu().solve(anchor.p_B - before_B);
  return on;
}

bool UnitRouter::pushViasOut(std::size_t i, Place& place) const {
  bool outside = true;
  for (std::size_t p = 0; p < place.points.size(); ++p) {
    const PointGuide& guide = prepared_.guides(i)[p];
    if (!guide.attachment && guide.bone >= 0 && place.free_m[p] <= 0 && !place.points[p].basis_B.isZero(0))
      outside &= pushOut(guide, place.points[p], place.anchors[p], place.free_m[p]);
  }
  return outside;
}

/// Every point to where it may be; whether any was not there. What is there stays, to the last bit.
bool UnitRouter::settle(std::size_t i, Place& place) const {
  const std::vector<UnitProblem::Point> before = place.points;
  place.settled = true;
  place.fits = pushViasOut(i, place);
  for (std::size_t p = 0; p < place.points.size(); ++p)
    if (place.points[p].slides)
      place.fits &= putOntoBone(prepared_.guides(i)[p], place.points[p], place.anchors[p].front(), place.free_m[p]);
  return !std::ranges::equal(before, place.points, {}, &UnitProblem::Point::moved_B, &UnitProblem::Point::moved_B);
}

bool UnitRouter::fits(std::size_t i, const MusculotendonUnit& unit) const {
  Place place;
  for (std::size_t p = 0; p < unit.path.size(); ++p) {
    const PointGuide& guide = prepared_.guides(i)[p];
    place.anchors.push_back(unit.path[p].anchors);
    place.points.push_back({.basis_W = guide.basis_B, .basis_B = guide.basis_B});
    place.points.back().slides = guide.attachment && !guide.basis_B.isZero(0);
    place.free_m.push_back(0);
  }
  return !settle(i, place) && place.fits;
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
    const PointGuide& guide = prepared_.guides(i)[p];
    UnitProblem::Point& point = to.points[p];
    std::vector<Anchor>& anchors = to.anchors[p];
    point.moved_B += before.basis_B * step;
    if (guide.attachment) {
      const Eigen::Vector3d before_B = anchors.front().p_B;
      slide(i, p, point, anchors.front());
      to.free_m[p] -= (anchors.front().p_B - before_B).norm();
    } else {
      const Eigen::Vector3d d_W = before.basis_W * step;
      displace(d_W, point, anchors);
      to.free_m[p] -= d_W.norm();
      constexpr double kFlat_m = 0.001;  // for so far a bone is taken for flat
      if (guide.bone >= 0 && d_W.norm() > kFlat_m) setGuard(guide.bone, guide.clearance_m, anchors, point);
    }
  }
  if (to.settled)
    settle(i, to);
  else
    to.fits = pushViasOut(i, to);
  for (std::size_t p = 0; p < to.points.size(); ++p)
    if (to.points[p].moved_B != from.points[p].moved_B) problem.movePoint(p, to.anchors[p], to.points[p]);
  evaluate(to, problem);
  return to;
}

/// Back to the surface of its bone, at the distance that it had.
void UnitRouter::slide(std::size_t unit, std::size_t p, UnitProblem::Point& point, Anchor& anchor) const {
  const PointGuide& guide = prepared_.guides(unit)[p];
  const Eigen::Vector3d before_B = reference_.musculature.units[unit].path[p].anchors.front().p_B;
  const Eigen::Vector3d flat_B = before_B + point.moved_B;
  const auto surface = prepared_.bones().bones()[static_cast<std::size_t>(guide.bone)].distance.nearest(flat_B);
  const Eigen::Vector3d outward_B = surface.outward(flat_B), p_B = surface.point + guide.clearance_m * outward_B;
  point.moved_B = p_B - before_B;
  anchor.p_B = deform(reference_.skeleton, shape_, anchor.segment, p_B);
  setBasis(anchor, p_B, tangentBasis(outward_B), point);
}

/// `problem` stands where the points are.
void UnitRouter::evaluate(Place& place, const UnitProblem& problem) const {
  place.energy = problem.parts(Eigen::VectorXd::Zero(problem.unknowns()));
  place.objective = total(place.energy) + problem.watchedPrice();
}

double UnitRouter::largestMove_m(const Place& before, const Place& after) const {
  double largest_m = 0;
  for (std::size_t p = 0; p < before.anchors.size(); ++p)
    largest_m = std::max(largest_m, (atRest(after.anchors[p]) - atRest(before.anchors[p])).norm());
  return largest_m;
}

}  // namespace sinew
