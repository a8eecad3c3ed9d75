#include "core/model/path_clearance.h"

#include <algorithm>
#include <ranges>

#include "core/muscle/muscle_path.h"
#include "core/parallel.h"

namespace sinew {
namespace {

using Poses = std::vector<RigidTransform>;

/// One world point against the bones of some segments; keeps the deepest.
class PointProbe {
 public:
  PointProbe(const BoneDistances& bones, const std::vector<bool>& segments) {
    for (std::size_t s = 0; s < segments.size(); ++s) {
      if (!segments[s]) continue;
      std::vector<const BoneDistances::Bone*> of_segment;
      for (const auto& bone : bones.bones())
        if (bone.segment == int(s)) of_segment.push_back(&bone);
      if (!of_segment.empty()) by_segment_.emplace_back(s, std::move(of_segment));
    }
  }

  /// Depth at p_W, and the bone.
  std::pair<double, const BoneDistances::Bone*> operator()(const Poses& X_BW, const Eigen::Vector3d& p_W) const {
    double deepest = 0;
    const BoneDistances::Bone* found = nullptr;
    for (const auto& [segment, bones] : by_segment_) {
      const Eigen::Vector3d p_B = X_BW[segment] * p_W;
      for (const auto* bone : bones) {
        if ((p_B.array() < bone->low_B.array()).any() || (p_B.array() > bone->high_B.array()).any()) continue;
        const double depth = bone->distance.depth_m(p_B);
        if (depth > deepest) deepest = depth, found = bone;
      }
    }
    return {deepest, found};
  }

 private:
  std::vector<std::pair<std::size_t, std::vector<const BoneDistances::Bone*>>> by_segment_;
};

void probePath(const MusculotendonUnit& unit, const PointProbe& probe, const Poses& X_WB, const Poses& X_BW,
               double step_m, int posture, PathPenetration& worst) {
  const auto points = pathPoints(unit, X_WB);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector3d d = points[i + 1] - points[i];
    const int steps = std::max(1, static_cast<int>(std::ceil(d.norm() / step_m)));
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector3d p_W = points[i] + d * (static_cast<double>(k) / steps);
      const auto [depth, bone] = probe(X_BW, p_W);
      if (depth > worst.depth_m) worst = {depth, bone->name, posture, static_cast<int>(i), p_W};
    }
  }
}

}  // namespace

std::vector<bool> spannedSegments(const Skeleton& skeleton, const MusculotendonUnit& unit) {
  std::vector<bool> hung(skeleton.segments.size(), false), chain = hung;
  for (const auto& point : unit.path)
    for (const auto& anchor : point.anchors) hung[std::size_t(anchor.segment)] = true;
  std::vector<int> below(skeleton.segments.size(), 0);  // hung segments at or below
  for (std::size_t s = 0; s < hung.size(); ++s)
    for (int a = hung[s] ? int(s) : -1; a >= 0; a = skeleton.segments[std::size_t(a)].parent) ++below[std::size_t(a)];
  const int all = int(std::ranges::count(hung, true));
  for (std::size_t s = 0; s < hung.size(); ++s) {
    if (below[s] == 0) continue;
    const bool common = below[s] == all;
    const bool last_common =
        common && (hung[s] || std::ranges::none_of(std::views::iota(std::size_t{0}, hung.size()), [&](std::size_t c) {
                     return skeleton.segments[c].parent == int(s) && below[c] == all;
                   }));
    chain[s] = !common || last_common;
  }
  for (std::size_t s = skeleton.joints.size(); s < hung.size(); ++s)
    if (const int parent = skeleton.segments[s].parent; parent >= 0 && chain[std::size_t(parent)]) chain[s] = true;
  return chain;
}

BoneDistances::BoneDistances(const Model& model) {
  for (const BoneMesh& bone : *model.bones) {
    Eigen::Vector3d low = bone.mesh.vertices.front(), high = low;
    for (const auto& v : bone.mesh.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
    bones_.push_back({bone.bone, bone.segment, low, high, MeshDistance{bone.mesh}});
  }
}

BoneDistances::Surface BoneDistances::nearest(int segment, const Eigen::Vector3d& p_B, std::string_view bone) const {
  Surface best;
  for (const Bone& candidate : bones_) {
    if (candidate.segment != segment || !candidate.name.starts_with(bone)) continue;
    const auto nearest = candidate.distance.nearest(p_B);
    if (nearest.distance_m < best.nearest.distance_m) best = {candidate.name, nearest};
  }
  return best;
}

std::vector<PathPenetration> measurePenetration(const Model& model, const BoneDistances& bones,
                                                std::span<const Posture> postures, const ClearanceOptions& options,
                                                const Job& job) {
  std::vector<Poses> X_WB, X_BW;
  for (const Posture& q : postures) {
    X_WB.push_back(segmentPoses(model.skeleton, q));
    X_BW.emplace_back();
    for (const auto& X : X_WB.back()) X_BW.back().push_back(X.inverse());
  }
  const auto& units = model.musculature.units;
  std::vector<PathPenetration> worst(units.size());
  forEachInParallel(units.size(), job, "path clearance", [&](std::size_t u) {
    const PointProbe probe{bones, spannedSegments(model.skeleton, units[u])};
    for (std::size_t k = 0; k < postures.size(); ++k)
      probePath(units[u], probe, X_WB[k], X_BW[k], options.step_m, static_cast<int>(k), worst[u]);
  });
  return worst;
}

std::vector<AttachmentDistance> measureAttachments(const Model& model, const BoneDistances& bones) {
  std::vector<AttachmentDistance> distances;
  for (const auto& unit : model.musculature.units) {
    // A blended end is judged on the segment that carries most of it.
    const auto surfaceAt = [&](const PathPoint& point) {
      const auto heaviest = std::ranges::max_element(point.anchors, {}, &Anchor::weight);
      return bones.nearest(heaviest->segment, heaviest->p_B);
    };
    const auto origin = surfaceAt(unit.path.front()), insertion = surfaceAt(unit.path.back());
    distances.push_back({origin.nearest.distance_m, insertion.nearest.distance_m, origin.bone, insertion.bone});
  }
  return distances;
}

}  // namespace sinew
