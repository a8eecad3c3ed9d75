#include "core/retarget/routing/routing.h"

#include <algorithm>

#include "core/parallel.h"
#include "core/retarget/prepared/routing_reference.h"
#include "core/retarget/routing/unit_router_internal.h"
#include "core/text.h"

namespace sinew {
namespace {

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

namespace {

/// The unit whose mirror image unit i is in a body of this shape, if that comes first; else -1.
int mirrorBefore(const RoutingReference& prepared, const std::vector<double>& shape, std::size_t i) {
  const int mirror = prepared.mirrorOf()[i];
  const bool first = mirror >= 0 && static_cast<std::size_t>(mirror) < i;
  return first && prepared.dependencies().symmetric(i, shape) ? mirror : -1;
}

}  // namespace

std::vector<bool> unchangedUnits(const RoutingReference& prepared, const ShapeParameters& previous,
                                 const ShapeParameters& shape) {
  const std::vector<double> before = toVector(previous), now = toVector(shape);
  std::vector<bool> unchanged;
  for (std::size_t i = 0; i < prepared.mirrorOf().size(); ++i)
    unchanged.push_back(prepared.dependencies().equal(i, before, now) &&
                        mirrorBefore(prepared, before, i) == mirrorBefore(prepared, now, i));
  return unchanged;
}

Routing route(const Model& reference, const RoutingReference& prepared, Model& model, const RoutingOptions& options,
              const Job& job, const PreviousRouting* previous) {
  require(reference.musculature.units.size() == model.musculature.units.size(), "route: the same units");
  const std::vector<double> shape = toVector(model.shape);
  const MotionPoses poses{model.skeleton, prepared.motions()};
  const BodyBones bones{reference, prepared.bones(), model};
  const UnitRouter router{reference, prepared, shape, poses, bones, options};
  const auto mirrorOf = [&](std::size_t i) { return mirrorBefore(prepared, shape, i); };
  std::vector<bool> unchanged(model.musculature.units.size(), false);
  if (previous) unchanged = unchangedUnits(prepared, previous->model.shape, model.shape);
  std::vector<MusculotendonUnit> units = model.musculature.units;
  Routing routing{.units = std::vector<UnitRouting>(units.size())};
  const bool done = forEachInParallel(units.size(), job, "routing", [&](std::size_t i) {
    if (unchanged[i]) {
      routing.units[i] = previous->units[i];
      units[i].path = previous->model.musculature.units[i].path;
    } else if (mirrorOf(i) < 0) {
      routing.units[i] = router(i, units[i], job.stop);
    }
  });
  if (!done) return {.outcome = Outcome::Cancelled};
  for (std::size_t i = 0; i < units.size(); ++i)
    if (const int mirror = mirrorOf(i); mirror >= 0 && !unchanged[i]) {
      MusculotendonUnit unit = units[i];
      mirrorPath(units[static_cast<std::size_t>(mirror)], unit);
      if (options.method == RetargetMethod::Naive || router.fits(i, unit)) {
        routing.units[i] = routing.units[static_cast<std::size_t>(mirror)];
        routing.units[i].unit = unit.name;
        units[i] = std::move(unit);
      } else {  // bones of the midline are not quite their own mirror images
        routing.units[i] = router(i, units[i], job.stop);
      }
    }
  model.musculature.units = std::move(units);
  routing.outcome = Outcome::Converged;
  return routing;
}

}  // namespace sinew
