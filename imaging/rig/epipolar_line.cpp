#include <algorithm>
#include <cmath>

#include "imaging/rig/triangulate.h"

namespace sinew {
namespace {

constexpr double kReach_m = 10;  // longer than any room
constexpr double kStep_m = 0.01;
constexpr double kStraight_px = 0.02;  // smaller bends are not drawn

/// Part of the segment a-b inside the image's outline (Liang & Barsky 1984). Returns false if there is none.
bool clipToImage(const View& view, Eigen::Vector2d& a, Eigen::Vector2d& b) {
  const Eigen::Vector2d low{-0.5, -0.5}, high{view.width_px - 0.5, view.height_px - 0.5}, d = b - a;
  double enter = 0, leave = 1;
  for (int k = 0; k < 2; ++k) {
    if (std::abs(d[k]) < 1e-12) {
      if (a[k] < low[k] || a[k] > high[k]) return false;
      continue;
    }
    const double t0 = (low[k] - a[k]) / d[k], t1 = (high[k] - a[k]) / d[k];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  if (enter > leave) return false;
  b = a + leave * d;
  a += enter * d;
  return true;
}

double distanceToLine(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  if (d.norm() < 1e-12) return (p - a).norm();
  return std::abs(d.x() * (p - a).y() - d.y() * (p - a).x()) / d.norm();
}

/// Drops the points that lie on the line between those kept (Douglas & Peucker 1973).
void simplify(const std::vector<Eigen::Vector2d>& line, std::size_t first, std::size_t last,
              std::vector<Eigen::Vector2d>& kept) {
  std::size_t worst = first;
  double deviation_px = kStraight_px;
  for (std::size_t i = first + 1; i < last; ++i)
    if (const double d = distanceToLine(line[i], line[first], line[last]); d > deviation_px)
      deviation_px = d, worst = i;
  if (worst != first) {
    simplify(line, first, worst, kept);
    simplify(line, worst, last, kept);
  } else {
    kept.push_back(line[last]);
  }
}

}  // namespace

std::vector<Eigen::Vector2d> epipolarLine(const BiplanarRig& rig, int view, const Eigen::Vector2d& uv_px,
                                          int other_view) {
  const auto known = [&](int v) { return v >= 0 && v < int(rig.views.size()); };
  require(known(view) && known(other_view) && view != other_view, "two different views of the rig");
  const View& other = rig.views[std::size_t(other_view)];
  const Ray ray = backProject(rig.views[std::size_t(view)], uv_px);
  std::vector<Eigen::Vector2d> line;
  bool before_seen = false;
  Eigen::Vector2d before = Eigen::Vector2d::Zero(), now = before;
  // A parallel beam's ray starts in the middle of the room, so look both ways; what lies behind a point source is
  // cut.
  const bool both_ways = std::holds_alternative<Orthographic>(rig.views[std::size_t(view)].projection);
  for (double t_m = both_ways ? -kReach_m : kStep_m; t_m <= kReach_m; t_m += kStep_m) {
    const bool seen = project<double>(other, ray.origin_W + t_m * ray.direction_W, now);
    Eigen::Vector2d a = before, b = now;
    if (before_seen && seen && clipToImage(other, a, b)) {
      if (line.empty()) line.push_back(a);
      line.push_back(b);
    }
    before = now;
    before_seen = seen;
  }
  if (line.size() < 2) return {};
  std::vector<Eigen::Vector2d> kept{line.front()};
  simplify(line, 0, line.size() - 1, kept);
  return kept;
}

}  // namespace sinew
