#include "app/experiments/characters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/posture/validity.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "core/rom/poses/pose_sampler.h"

namespace sinew {
namespace {

double height_m(const Model& model) {
  const auto X_WB = segmentPoses(model.skeleton, zeroPosture(model.skeleton));
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  for (const BoneMesh& bone : *model.bones)
    for (const Eigen::Vector3d& p_B : bone.mesh.vertices) {
      const double y_m = (X_WB[std::size_t(bone.segment)] * p_B).y();
      low_m = std::min(low_m, y_m), high_m = std::max(high_m, y_m);
    }
  return model.bones->empty() ? 0 : high_m - low_m;
}

std::vector<RestingVerdict> atRest(const Model& model) {
  const std::vector<std::string> names = {"standing", "weightless", "arms sideways"};
  const auto postures = restingPostures(model.skeleton);
  require(postures.size() == names.size(), "a name for every resting posture");
  std::vector<RestingVerdict> verdicts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Validity v = validity(model.skeleton, model.musculature, postures[i]);
    verdicts.push_back({names[i], v.valid, nameOf(v.first, model.skeleton, model.musculature)});
  }
  return verdicts;
}

}  // namespace

Character makeCharacter(const RetargetReference& reference, const BodyDescription& body, const Job& job) {
  Character character{.body = body, .retargeted = retarget(reference, body.shape, {.physics = body.physics}, job)};
  if (character.retargeted.outcome != Outcome::Converged) return character;
  Model& model = character.retargeted.model;
  model.name = body.name;
  character.height_m = height_m(model);
  for (const Segment& segment : model.skeleton.segments) character.mass_kg += segment.mass_kg;
  character.at_rest = atRest(model);
  return character;
}

EnergyTotals energyTotals(std::span<const UnitRouting> routing, const RoutingWeights& weights) {
  EnergyTotals totals;
  for (const UnitRouting& unit : routing) {
    totals.start += unit.start.total(weights);
    totals.end += unit.end.total(weights);
    totals.paper_start += unit.start.paper(weights);
    totals.paper_end += unit.end.paper(weights);
  }
  return totals;
}

PeakTorqueTotals peakTorqueTotals(std::span<const PeakTorqueAngle> angles) {
  PeakTorqueTotals totals;
  for (const PeakTorqueAngle& a : angles) {
    if (!std::isfinite(a.reference_deg)) continue;
    ++totals.motions;
    // A motion that nothing drives any more is as wrong as can be.
    const auto off_deg = [&](double angle_deg) {
      return std::isfinite(angle_deg) ? std::abs(angle_deg - a.reference_deg) : 180;
    };
    const double before_deg = off_deg(a.before_deg), after_deg = off_deg(a.after_deg);
    totals.within_before += before_deg <= kPeakTorqueTarget_deg;
    totals.within_after += after_deg <= kPeakTorqueTarget_deg;
    totals.worst_before_deg = std::max(totals.worst_before_deg, before_deg);
    totals.worst_after_deg = std::max(totals.worst_after_deg, after_deg);
  }
  return totals;
}

}  // namespace sinew
