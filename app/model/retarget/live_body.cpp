#include "app/model/retarget/live_body.h"

#include <algorithm>

#include "core/muscle/muscle_path.h"
#include "core/skeleton/shape/bone_field.h"

namespace sinew {
namespace {

/// Points all over a segment's surfaces and its path points: what a parameter does not move here it does not move.
std::vector<std::vector<Eigen::Vector3d>> probes(const Model& model) {
  constexpr std::size_t kOfABone = 24;
  std::vector<std::vector<Eigen::Vector3d>> points(model.skeleton.segments.size());
  for (const auto& bone : *model.bones) {
    const auto& vertices = bone.mesh.vertices;
    const std::size_t step = std::max<std::size_t>(1, vertices.size() / kOfABone);
    for (std::size_t i = 0; i < vertices.size(); i += step) points[std::size_t(bone.segment)].push_back(vertices[i]);
  }
  for (const auto& unit : model.musculature.units)
    for (const auto& point : unit.path)
      for (const auto& anchor : point.anchors) points[std::size_t(anchor.segment)].push_back(anchor.p_B);
  return points;
}

std::vector<std::vector<bool>> affectedSegments(const Model& model) {
  const auto points = probes(model);
  // A shape in which no parameter is neutral: some act only together with others.
  std::vector<double> base = toVector(ShapeParameters{});
  for (std::size_t i = 0; i < base.size(); ++i) base[i] += base[i] == 0 ? 0.11 : 0.07 + 0.001 * double(i);
  std::vector<std::vector<bool>> affects(base.size(), std::vector<bool>(points.size(), false));
  for (std::size_t parameter = 0; parameter < base.size(); ++parameter) {
    std::vector<double> moved = base;
    moved[parameter] += 0.05;
    for (std::size_t s = 0; s < points.size(); ++s)
      affects[parameter][s] = std::ranges::any_of(points[s], [&](const Eigen::Vector3d& p) {
        return deform(model.skeleton, base, int(s), p) != deform(model.skeleton, moved, int(s), p);
      });
  }
  return affects;
}

}  // namespace

LiveBody::LiveBody(std::shared_ptr<const Model> reference)
    : reference_{std::move(reference)}, affects_{affectedSegments(*reference_)} {
  const auto X_WB = segmentPoses(reference_->skeleton, zeroPosture(reference_->skeleton));
  for (const auto& unit : reference_->musculature.units) reference_length_m_.push_back(pathLength(unit, X_WB));
}

std::vector<bool> LiveBody::affectedBy(const ShapeParameters& shape) const {
  const auto before = toVector(last_->shape), after = toVector(shape);
  std::vector<bool> affected(reference_->skeleton.segments.size(), false);
  for (std::size_t i = 0; i < after.size(); ++i)
    if (before[i] != after[i])
      for (std::size_t s = 0; s < affected.size(); ++s) affected[s] = affected[s] || affects_[i][s];
  return affected;
}

std::shared_ptr<const Model> LiveBody::deformed(const ShapeParameters& shape) {
  if (!last_ || shape == ShapeParameters{})
    return last_ = std::make_shared<const Model>(deformedModel(*reference_, shape));
  const Model& reference = *reference_;
  const std::vector<bool> affected = affectedBy(shape);
  auto model = std::make_shared<Model>(*last_);
  model->shape = shape;
  model->skeleton = deformedSkeleton(reference.skeleton, shape);
  model->passive_moments = scaledStructures(reference.passive_moments, reference.skeleton, model->skeleton);
  const std::vector<double> parameters = toVector(shape);
  auto bones = std::make_shared<std::vector<BoneMesh>>(*last_->bones);
  for (std::size_t b = 0; b < bones->size(); ++b) {
    const BoneMesh& from = (*reference.bones)[b];
    if (!affected[std::size_t(from.segment)]) continue;
    for (std::size_t v = 0; v < from.mesh.vertices.size(); ++v)
      (*bones)[b].mesh.vertices[v] = deform(reference.skeleton, parameters, from.segment, from.mesh.vertices[v]);
  }
  model->bones = std::move(bones);
  const auto X_WB = segmentPoses(model->skeleton, zeroPosture(model->skeleton));
  for (std::size_t u = 0; u < model->musculature.units.size(); ++u) {
    MusculotendonUnit& unit = model->musculature.units[u];
    const MusculotendonUnit& from = reference.musculature.units[u];
    for (std::size_t p = 0; p < unit.path.size(); ++p)
      for (std::size_t a = 0; a < unit.path[p].anchors.size(); ++a) {
        const Anchor& anchor = from.path[p].anchors[a];
        if (affected[std::size_t(anchor.segment)])
          unit.path[p].anchors[a].p_B = deform(reference.skeleton, parameters, anchor.segment, anchor.p_B);
      }
    const double ratio = pathLength(unit, X_WB) / reference_length_m_[u];
    unit.optimal_fiber_length_m = from.optimal_fiber_length_m * ratio;
    unit.tendon_slack_length_m = from.tendon_slack_length_m * ratio;
  }
  return last_ = std::move(model);
}

}  // namespace sinew
