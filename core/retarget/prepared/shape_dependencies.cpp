#include "core/retarget/prepared/shape_dependencies.h"

#include <algorithm>

#include "core/model/path_clearance.h"
#include "core/skeleton/shape/bone_field.h"

namespace sinew {
namespace {

/// Points of every segment, all over it: path points, and bone surface.
std::vector<std::vector<Eigen::Vector3d>> pointsOf(const Model& reference) {
  constexpr std::size_t kStride = 29;  // between vertices of a mesh
  std::vector<std::vector<Eigen::Vector3d>> points(reference.skeleton.segments.size());
  for (const MusculotendonUnit& unit : reference.musculature.units)
    for (const PathPoint& point : unit.path)
      for (const Anchor& anchor : point.anchors)
        points[static_cast<std::size_t>(anchor.segment)].push_back(anchor.p_B);
  for (const BoneMesh& bone : *reference.bones)
    for (std::size_t v = 0; v < bone.mesh.vertices.size(); v += kStride)
      points[static_cast<std::size_t>(bone.segment)].push_back(bone.mesh.vertices[v]);
  return points;
}

/// By segment: whether it is felt there that one parameter of `shape` is another.
std::vector<bool> segmentsFeeling(const Model& reference, const std::vector<std::vector<Eigen::Vector3d>>& points,
                                  std::vector<double> shape, std::size_t parameter) {
  constexpr double kChange = 0.03, kLength_m = 0.003, kAngle_rad = 0.3;
  const Posture bent = Posture::Constant(reference.skeleton.coordinateCount(), kAngle_rad);
  const std::vector<double> before = shape;
  shape[parameter] += shapeUnit(shapeParameterNames()[parameter]) == ShapeUnit::Length ? kLength_m : kChange;
  const auto X = segmentPoses(deformedSkeleton(reference.skeleton, shapeFromVector(before)), bent);
  const auto Y = segmentPoses(deformedSkeleton(reference.skeleton, shapeFromVector(shape)), bent);
  std::vector<bool> feels;
  for (std::size_t s = 0; s < points.size(); ++s)
    feels.push_back(X[s].matrix() != Y[s].matrix() || std::ranges::any_of(points[s], [&](const Eigen::Vector3d& p) {
                      const int segment = static_cast<int>(s);
                      return deform(reference.skeleton, before, segment, p) !=
                             deform(reference.skeleton, shape, segment, p);
                    }));
  return feels;
}

/// Segments that a unit hangs on, or whose bones it has to get around.
std::vector<bool> segmentsOf(const Skeleton& skeleton, const MusculotendonUnit& unit) {
  std::vector<bool> segments = spannedSegments(skeleton, unit);
  for (const PathPoint& point : unit.path)
    for (const Anchor& anchor : point.anchors) segments[static_cast<std::size_t>(anchor.segment)] = true;
  return segments;
}

/// The same parameter of the other side; itself if it has no side.
std::vector<std::size_t> mirrorImages() {
  ShapeParameters numbered = shapeFromVector([] {
    std::vector<double> numbers(shapeParameterNames().size());
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<double>(k);
    return numbers;
  }());
  std::swap(numbered.sides[0], numbered.sides[1]);
  std::vector<std::size_t> images;
  for (const double number : toVector(numbered)) images.push_back(static_cast<std::size_t>(number));
  return images;
}

}  // namespace

ShapeDependencies::ShapeDependencies(const Model& reference) : felt_(reference.musculature.units.size()) {
  const auto points = pointsOf(reference);
  std::vector<std::vector<bool>> concerned;  // by unit and segment
  for (const MusculotendonUnit& unit : reference.musculature.units)
    concerned.push_back(segmentsOf(reference.skeleton, unit));
  std::vector<double> shape = toVector(ShapeParameters{});
  for (std::size_t k = 0; k < shape.size(); ++k)  // a body in which every parameter matters
    shape[k] += shapeUnit(shapeParameterNames()[k]) == ShapeUnit::Length ? 0.01 : 0.1;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const std::vector<bool> feels = segmentsFeeling(reference, points, shape, k);
    for (std::size_t u = 0; u < felt_.size(); ++u)
      for (std::size_t s = 0; s < feels.size(); ++s)
        if (feels[s] && concerned[u][s]) {
          felt_[u].push_back(static_cast<int>(k));
          break;
        }
  }
}

bool ShapeDependencies::equal(std::size_t unit, const std::vector<double>& a, const std::vector<double>& b) const {
  return std::ranges::all_of(felt_[unit],
                             [&](int k) { return a[static_cast<std::size_t>(k)] == b[static_cast<std::size_t>(k)]; });
}

bool ShapeDependencies::symmetric(std::size_t unit, const std::vector<double>& shape) const {
  static const std::vector<std::size_t> images = mirrorImages();
  return std::ranges::all_of(felt_[unit], [&](int k) {
    return shape[static_cast<std::size_t>(k)] == shape[images[static_cast<std::size_t>(k)]];
  });
}

}  // namespace sinew
