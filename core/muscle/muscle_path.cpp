#include "core/muscle/muscle_path.h"

#include <algorithm>

namespace sinew {
namespace {

Eigen::Vector3d pointInWorld(const PathPoint& point, const std::vector<RigidTransform>& X_WB) {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  for (const Anchor& a : point.anchors) p_W += a.weight * (X_WB[a.segment] * a.p_B);
  return p_W;
}

/// From a to b, unit length; zero where the points coincide, so that such a segment neither pulls nor divides by 0.
Eigen::Vector3d direction(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = b - a;
  const double length = d.norm();
  return length > 0 ? Eigen::Vector3d{d / length} : Eigen::Vector3d::Zero();
}

}  // namespace

std::vector<Eigen::Vector3d> pathPoints(const MusculotendonUnit& unit, const std::vector<RigidTransform>& X_WB) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(unit.path.size());
  for (const PathPoint& point : unit.path) points.push_back(pointInWorld(point, X_WB));
  return points;
}

double pathLength(const MusculotendonUnit& unit, const std::vector<RigidTransform>& X_WB) {
  double length = 0;
  Eigen::Vector3d previous = pointInWorld(unit.path.front(), X_WB);
  for (std::size_t i = 1; i < unit.path.size(); ++i) {
    const Eigen::Vector3d next = pointInWorld(unit.path[i], X_WB);
    length += (next - previous).norm();
    previous = next;
  }
  return length;
}

Eigen::VectorXd lengthGradient(const MusculotendonUnit& unit, const Kinematics& k) {
  const std::vector<Eigen::Vector3d> points = pathPoints(unit, k.X_WB);
  // dl = sum over the points of pull . dp, pull = unit vector from the point before minus that to the point after.
  // A blended point moves with the weighted velocity of its anchors, each at its own place: the same weights that
  // distribute a force over the segments, so that work is conserved.
  int count = 0;
  for (const auto& motions : k.motions)
    for (const SegmentMotion& m : motions) count = std::max(count, m.coordinate + 1);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Vector3d pull = Eigen::Vector3d::Zero();
    if (i > 0) pull += direction(points[i - 1], points[i]);
    if (i + 1 < points.size()) pull -= direction(points[i], points[i + 1]);
    for (const Anchor& a : unit.path[i].anchors) {
      const Eigen::Vector3d p_W = k.X_WB[a.segment] * a.p_B;
      for (const SegmentMotion& m : k.motions[a.segment])
        gradient[m.coordinate] += a.weight * pull.dot(m.twist.at(p_W));
    }
  }
  return gradient;
}

}  // namespace sinew
