#include "app/experiments/disorders.h"

#include <algorithm>

#include "app/experiments/experiment_shapes.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

using Poses = std::vector<RigidTransform>;

/// Poses of all segments at the ends of the steps of one motion.
std::vector<Poses> posesOver(const Skeleton& skeleton, const JointMotion& motion, int steps) {
  std::vector<Poses> poses;
  for (int s = 0; s <= steps; ++s)
    poses.push_back(segmentPoses(skeleton, motionPosture(skeleton, motion, double(s) / steps)));
  return poses;
}

}  // namespace

std::vector<double> reversalShares(const RetargetReference& reference, const Model& body, int steps) {
  const auto& routing = reference.routing();
  const auto& units = reference.model().musculature.units;
  std::vector<StepCount> counts(units.size());
  for (std::size_t m = 0; m < routing.motions().size(); ++m) {
    const JointMotion& motion = findMotion(reference.motions(), routing.motions()[m].name);
    const auto before = posesOver(reference.model().skeleton, motion, steps),
               now = posesOver(body.skeleton, motion, steps);
    for (std::size_t u = 0; u < units.size(); ++u) {
      const ReferenceCurves& curves = routing.curves(u);
      const auto at = std::ranges::find(curves.motions, static_cast<int>(m));
      if (at == curves.motions.end() || curves.significance[std::size_t(at - curves.motions.begin())] == 0) continue;
      countReversals(stepDirections(lengthsOver(units[u], before)), lengthsOver(body.musculature.units[u], now),
                     counts[u]);
    }
  }
  std::vector<double> shares;
  for (const StepCount& c : counts) shares.push_back(c.share());
  return shares;
}

Disorders disorders(const RetargetReference& reference, const DisorderOptions& options, const Job& job) {
  Disorders result;
  for (const auto& unit : reference.model().musculature.units) result.units.push_back(unit.name);
  for (const double elongation : options.elongations) {
    job.report(double(result.rows.size()) / double(options.elongations.size()), "functional disorders");
    const ShapeParameters shape = withLimbElongation(elongation);
    const Retargeted body = retarget(reference, shape, {.peak_torque = false}, {.stop = job.stop});
    if (body.outcome != Outcome::Converged) return {.outcome = body.outcome};
    result.rows.push_back({elongation,
                           reversalShares(reference, deformedModel(reference.model(), shape), options.steps),
                           reversalShares(reference, body.model, options.steps)});
  }
  result.outcome = Outcome::Converged;
  return result;
}

}  // namespace sinew
