#include "core/retarget/prepared/routing_reference.h"

#include <algorithm>
#include <cmath>

#include "core/muscle/muscle_path.h"
#include "core/parallel.h"
#include "core/posture/muscle_role.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

bool sameWay(const JointMotion& a, const JointMotion& b) {
  return a.coordinate == b.coordinate && a.other_posture_deg == b.other_posture_deg &&
         ((a.start_deg == b.start_deg && a.end_deg == b.end_deg) ||
          (a.start_deg == b.end_deg && a.end_deg == b.start_deg));
}

/// A motion and its way back have the same directions and the same curve mirrored in theta, hence the same energy:
/// they are sampled once and counted twice.
std::vector<std::pair<const JointMotion*, int>> distinctWays(const std::vector<JointMotion>& motions) {
  std::vector<std::pair<const JointMotion*, int>> ways;
  for (const JointMotion& motion : motions) {
    const auto known = std::ranges::find_if(ways, [&](const auto& way) { return sameWay(*way.first, motion); });
    if (known == ways.end())
      ways.emplace_back(&motion, 1);
    else
      ++known->second;
  }
  return ways;
}

std::vector<RoutingMotion> sampled(const std::vector<std::pair<const JointMotion*, int>>& ways,
                                   const Skeleton& skeleton) {
  std::vector<RoutingMotion> motions;
  for (const auto& [way, count] : ways) {
    RoutingMotion& motion = motions.emplace_back(way->name, skeleton.coordinateIndex(way->coordinate), double(count));
    for (int s = 0; s < kRoutingSamples; ++s)
      motion.postures.push_back(motionPosture(skeleton, *way, double(s) / (kRoutingSamples - 1)));
    for (int s = 0; s <= kReversalSteps; ++s)
      motion.steps.push_back(motionPosture(skeleton, *way, double(s) / kReversalSteps));
  }
  return motions;
}

ReferenceCurves curvesOf(const MusculotendonUnit& unit, const std::vector<int>& motions, const MotionPoses& poses) {
  ReferenceCurves c;
  c.motions = motions;
  c.zero_length_m = pathLength(unit, poses.atZero());
  for (const int motion : motions) {
    for (int s = 0; s < kRoutingSamples; ++s) {
      const auto points = pathPoints(unit, poses.at(motion, s));
      double length_m = 0;
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Eigen::Vector3d d = points[i + 1] - points[i];
        length_m += d.norm();
        c.directions.push_back(d.normalized());
      }
      c.lengths.push_back(length_m / c.zero_length_m);
    }
    c.features.push_back(curveFeatures(std::span{c.lengths}.last(kRoutingSamples)));
    c.significance.push_back(c.features.back().range() > kSignificantRange ? 1 : 0);
    auto& lengths = c.step_lengths.emplace_back();
    if (c.significance.back() > 0) lengths = lengthsOver(unit, poses.over(motion));
    c.step_directions.push_back(lengths.empty() ? std::vector<int>{} : stepDirections(lengths));
    for (double& length : lengths) length /= c.zero_length_m;
  }
  return c;
}

/// Bones of the given segments near a point, at the zero posture.
std::vector<int> nearBones(const Eigen::Vector3d& p_W, const std::vector<bool>& segments, const BoneDistances& bones,
                           const MotionPoses::Poses& X_WB) {
  constexpr double kNear_m = 0.06;
  std::vector<int> near;
  for (std::size_t b = 0; b < bones.bones().size(); ++b) {
    const BoneDistances::Bone& bone = bones.bones()[b];
    const auto segment = static_cast<std::size_t>(bone.segment);
    if (!segments[segment]) continue;
    const Eigen::Vector3d p_B = X_WB[segment].inverse() * p_W;
    const bool beside = ((p_B - bone.high_B).array() > kNear_m).any() || ((bone.low_B - p_B).array() > kNear_m).any();
    if (!beside && bone.distance.nearest(p_B).distance_m < kNear_m) near.push_back(static_cast<int>(b));
  }
  return near;
}

PointGuide guideOf(const PathPoint& point, const BoneDistances& bones, const std::vector<bool>& spanned,
                   const MotionPoses::Poses& X_WB) {
  PointGuide guide;
  guide.attachment = point.role != PathPointRole::Via;
  const auto heaviest = std::ranges::max_element(point.anchors, {}, &Anchor::weight);
  guide.heaviest_anchor = static_cast<int>(heaviest - point.anchors.begin());
  BoneDistances::Surface nearest;
  Eigen::Vector3d outward_B = Eigen::Vector3d::Zero();
  for (const Anchor& anchor : point.anchors) {
    const auto surface = bones.nearest(anchor.segment, anchor.p_B);
    if (surface.nearest.distance_m < nearest.nearest.distance_m) {
      nearest = surface;
      guide.surface_segment = anchor.segment;
      outward_B = surface.nearest.outward(anchor.p_B);
    }
  }
  if (guide.surface_segment >= 0) {
    guide.surface_B = nearest.nearest.point;
    guide.clearance_m = nearest.nearest.distance_m;
    const auto found = std::ranges::find_if(bones.bones(), [&](const BoneDistances::Bone& bone) {
      return bone.segment == guide.surface_segment && bone.name == nearest.bone;
    });
    guide.bone = static_cast<int>(found - bones.bones().begin());
  }
  if (guide.attachment) {
    const bool slides = point.anchors.size() == 1 && guide.surface_segment >= 0;
    guide.basis_B = slides ? tangentBasis(outward_B) : Eigen::Matrix3d::Zero();
  }
  std::vector<bool> segments(X_WB.size(), false);
  if (guide.surface_segment >= 0) segments[static_cast<std::size_t>(guide.surface_segment)] = true;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  for (const Anchor& a : point.anchors) p_W += a.weight * (X_WB[static_cast<std::size_t>(a.segment)] * a.p_B);
  guide.near_bones = nearBones(p_W, guide.attachment ? segments : spanned, bones, X_WB);
  return guide;
}

bool mirrorImages(const Skeleton& skeleton, const MusculotendonUnit& a, const MusculotendonUnit& b) {
  if (a.path.size() != b.path.size()) return false;
  const auto sameAnchor = [&](const Anchor& x, const Anchor& y) {
    const std::string &right = skeleton.segments[static_cast<std::size_t>(x.segment)].name,
                      &left = skeleton.segments[static_cast<std::size_t>(y.segment)].name;
    return withoutSide(right) == withoutSide(left) && (x.segment != y.segment) == (right != withoutSide(right)) &&
           std::abs(x.weight - y.weight) < 1e-12 && (mirrored(x.p_B) - y.p_B).norm() < 1e-12;
  };
  for (std::size_t i = 0; i < a.path.size(); ++i)
    if (!std::ranges::equal(a.path[i].anchors, b.path[i].anchors, sameAnchor)) return false;
  return true;
}

std::vector<int> mirrorsIn(const Model& model) {
  const auto& units = model.musculature.units;
  std::vector<int> mirror_of(units.size(), -1);
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!units[i].name.ends_with("_r")) continue;
    const std::string left = std::string{withoutSide(units[i].name)} + "_l";
    const auto found = std::ranges::find(units, left, &MusculotendonUnit::name);
    if (found == units.end() || !mirrorImages(model.skeleton, units[i], *found)) continue;
    mirror_of[i] = static_cast<int>(found - units.begin());
    mirror_of[static_cast<std::size_t>(mirror_of[i])] = static_cast<int>(i);
  }
  return mirror_of;
}

}  // namespace

Eigen::Matrix3d tangentBasis(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d first = normal.unitOrthogonal();
  Eigen::Matrix3d basis = Eigen::Matrix3d::Zero();
  basis.col(0) = first;
  basis.col(1) = normal.cross(first);
  return basis;
}

MotionPoses::MotionPoses(const Skeleton& skeleton, const std::vector<RoutingMotion>& motions)
    : X_WB_(motions.size()), zero_{segmentPoses(skeleton, zeroPosture(skeleton))} {
  forEachInParallel(motions.size(), {}, "poses", [&](std::size_t m) {
    X_WB_[m].reserve(motions[m].steps.size());
    for (const Posture& q : motions[m].steps) X_WB_[m].push_back(segmentPoses(skeleton, q));
  });
}

RoutingReference::RoutingReference(const Model& reference, const std::vector<JointMotion>& motions)
    : motions_{sampled(distinctWays(motions), reference.skeleton)},
      poses_{reference.skeleton, motions_},
      bones_{reference},
      dependencies_{reference} {
  require(reference.shape == ShapeParameters{}, "RoutingReference: shapes are relative to the undeformed reference");
  const Kinematics clinical = clinicalKinematics(reference.skeleton, zeroPosture(reference.skeleton));
  for (const MusculotendonUnit& unit : reference.musculature.units) {
    const std::vector<int> spanned = spannedCoordinates(unit, clinical);
    std::vector<int> taken;
    for (std::size_t m = 0; m < motions_.size(); ++m)
      if (std::ranges::count(spanned, motions_[m].coordinate)) taken.push_back(static_cast<int>(m));
    curves_.push_back(curvesOf(unit, taken, poses_));
    std::vector<PointGuide>& guides = guides_.emplace_back();
    const std::vector<bool> segments = spannedSegments(reference.skeleton, unit);
    for (const PathPoint& point : unit.path) guides.push_back(guideOf(point, bones_, segments, poses_.atZero()));
  }
  mirror_of_ = mirrorsIn(reference);
}

}  // namespace sinew
