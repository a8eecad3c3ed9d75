#include "app/bench/dart_routing.h"

#include <algorithm>
#include <cmath>

#include "core/muscle/muscle_path.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/routing/routing.h"

namespace sinew {

DartRouting::DartRouting(const RetargetReference& reference, const Model& naive)
    : reference_{reference},
      naive_{naive},
      dart_{DartPeer::make(naive)},
      zero_{segmentPoses(naive.skeleton, zeroPosture(naive.skeleton))} {
  if (!dart_) return;
  for (const RoutingMotion& motion : reference.routing().motions()) {
    auto& of_motion = positions_.emplace_back();
    for (const Posture& q : motion.postures) of_motion.push_back(dart_->positions(q));
  }
}

std::vector<double> DartRouting::energies(std::size_t unit, const std::vector<Points>& displaced) {
  const RoutingWeights weights;
  const ReferenceCurves& wanted = reference_.routing().curves(unit);
  const MusculotendonUnit& path = naive_.musculature.units[unit];
  const std::size_t pieces = path.path.size() - 1;
  const double zero_length_m = pathLength(path, zero_);
  std::vector<double> sums(displaced.size(), 0.0);
  std::vector<std::vector<double>> lengths(displaced.size(), std::vector<double>(kRoutingSamples));
  Points p_W(path.path.size());
  for (std::size_t m = 0; m < wanted.motions.size(); ++m) {
    const auto motion = std::size_t(wanted.motions[m]);
    const double weight = reference_.routing().motions()[motion].weight;
    for (std::size_t s = 0; s < kRoutingSamples; ++s) {
      dart_->setPositions(positions_[motion][s]);
      const double share = (s == 0 || s + 1 == kRoutingSamples ? 0.5 : 1.0) / (kRoutingSamples - 1);  // trapezia
      for (std::size_t d = 0; d < displaced.size(); ++d) {
        for (std::size_t p = 0; p < p_W.size(); ++p) {
          p_W[p].setZero();
          for (const Anchor& a : path.path[p].anchors) {
            const Eigen::Vector3d moved_B = zero_[std::size_t(a.segment)].linear().transpose() * displaced[d][p];
            p_W[p] += a.weight * dart_->inWorld(a.segment, a.p_B + moved_B);
          }
        }
        double length_m = 0;
        for (std::size_t k = 0; k < pieces; ++k) {
          const Eigen::Vector3d piece = p_W[k + 1] - p_W[k];
          const double norm_m = std::max(piece.norm(), 1e-9);
          length_m += norm_m;
          sums[d] += weight * share *
                     wanted.directions[(m * kRoutingSamples + s) * pieces + k].cross(piece / norm_m).squaredNorm();
        }
        lengths[d][s] = length_m / zero_length_m;
      }
    }
    for (std::size_t d = 0; d < displaced.size(); ++d) {
      const CurveFeatures found = curveFeatures(lengths[d]), &reference = wanted.features[m];
      const double longest = found.longest.theta - reference.longest.theta,
                   shortest = found.shortest.theta - reference.shortest.theta,
                   range = found.range() - reference.range();
      sums[d] += weights.length * weight *
                 (wanted.significance[m] * (longest * longest + shortest * shortest) + weights.range * range * range);
    }
  }
  return sums;
}

std::vector<double> DartRouting::gradient(std::size_t unit, const Points& x, double energy_here,
                                          Differences differences) {
  constexpr double kStep_m = 1e-5;
  std::vector<Points> displaced;
  for (std::size_t p = 0; p < x.size(); ++p)
    for (int k = 0; k < 3; ++k) displaced.emplace_back(x)[p][k] += kStep_m;
  std::vector<double> slopes;
  if (differences == Differences::OnePass)
    slopes = energies(unit, displaced);
  else
    for (const Points& points : displaced) slopes.push_back(energy(unit, points));
  for (double& slope : slopes) slope = (slope - energy_here) / kStep_m;
  return slopes;
}

double DartRouting::startEnergy(std::size_t unit) {
  return energy(unit, Points(naive_.musculature.units[unit].path.size(), Eigen::Vector3d::Zero()));
}

double DartRouting::descend(std::size_t unit, Differences differences) {
  // As core/retarget/minimize.cpp, descent().
  constexpr int kMostIterations = 200, kMostTrials = 14;
  constexpr double kGrowth = 1.7, kShrink = 0.4, kSufficient = 1e-4, kFlat = 1e-7, kTolerance = 1e-6;
  Points x(naive_.musculature.units[unit].path.size(), Eigen::Vector3d::Zero());
  double reached = startEnergy(unit), step_m = 1e-3;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const std::vector<double> slopes = gradient(unit, x, reached, differences);
    const double slope = Eigen::Map<const Eigen::VectorXd>(slopes.data(), Eigen::Index(slopes.size())).norm();
    if (slope < kFlat) break;
    const double before = reached;
    bool better = false;
    for (int trial = 0; trial < kMostTrials && !better; ++trial) {
      Points moved = x;
      for (std::size_t i = 0; i < slopes.size(); ++i) moved[i / 3][Eigen::Index(i % 3)] -= slopes[i] * step_m / slope;
      const double found = energy(unit, moved);
      better = found < reached - kSufficient * step_m * slope;
      if (better) x = moved, reached = found;
      step_m *= better ? kGrowth : kShrink;
    }
    if (!better || before - reached < kTolerance * before) break;
  }
  return reached;
}

}  // namespace sinew
