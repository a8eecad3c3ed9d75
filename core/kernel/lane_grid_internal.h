#pragma once
#include <cstdint>

#include "core/kernel/grid_view_internal.h"
#include "core/kernel/lanes_internal.h"

namespace sinew {
namespace {

/// The same entry of W consecutive directions of a block table.
template <class L>
inline typename L::V entryOf(const float* table, int lane, int entry) {
  return *reinterpret_cast<const typename L::V*>(table + entry * GridView::kBlock + lane);
}

template <class L>
inline Vector3Of<L> turned(const float* m, const typename L::V* R) {
  return {R[0] * m[0] + R[1] * m[1] + R[2] * m[2], R[3] * m[0] + R[4] * m[1] + R[5] * m[2],
          R[6] * m[0] + R[7] * m[1] + R[8] * m[2]};
}

template <class L>
inline Vector3Of<L> gridPoint(const GridPoint& point, const typename L::V* R, const float* Q, int lane) {
  Vector3Of<L> p{L::set(point.f[0]), L::set(point.f[1]), L::set(point.f[2])};
  if (point.kind == GridPoint::Fixed) return p;
  const Vector3Of<L> moved = turned<L>(point.m, R);
  if (point.kind == GridPoint::Moving) return moved;
  p.x += moved.x, p.y += moved.y, p.z += moved.z;
  if (point.kind == GridPoint::WithRadius) {
    typename L::V of_radius[9];
    for (int i = 0; i < 9; ++i) of_radius[i] = entryOf<L>(Q, lane, i);
    const Vector3Of<L> more = turned<L>(point.n, of_radius);
    p.x += more.x, p.y += more.y, p.z += more.z;
  }
  return p;
}

/// Length minus the longest length.
template <class L>
inline typename L::V excess(const GridView& g, const GridMuscle& muscle, const typename L::V* R, const float* Q,
                            int lane) {
  typename L::V length = L::set(muscle.constant_m);
  for (int run = muscle.first_run; run < muscle.end_run; ++run) {
    Vector3Of<L> a = gridPoint<L>(g.points[g.run_points[run]], R, Q, lane);
    for (int i = g.run_points[run] + 1; i < g.run_points[run + 1]; ++i) {
      const Vector3Of<L> b = gridPoint<L>(g.points[i], R, Q, lane);
      const typename L::V dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
      length += L::sqrt(dx * dx + dy * dy + dz * dz);
      a = b;
    }
  }
  return length;
}

template <class L>
void laneGrid(const GridView& g, std::uint8_t* state) {
  using V = typename L::V;
  constexpr unsigned kAll = L::kCount == 32 ? ~0u : (1u << L::kCount) - 1;
  for (int first = 0; first < g.direction_count; first += L::kCount) {
    const std::size_t block = std::size_t(first / GridView::kBlock) * 9 * GridView::kBlock;
    const int lane = first % GridView::kBlock;
    V R[9];
    for (int i = 0; i < 9; ++i) R[i] = entryOf<L>(g.R + block, lane, i);
    unsigned forbidden = 0, close = 0;
    for (int i = 0; i < g.muscle_count && forbidden != kAll; ++i) {
      const V over = excess<L>(g, g.muscles[i], R, g.Q ? g.Q + block : nullptr, lane);
      const unsigned beyond = L::bits(over > L::set(GridView::kClose_m));
      close |= L::bits(over > L::set(-GridView::kClose_m));
      g.muscles[i].failures += __builtin_popcount(beyond & ~forbidden);
      forbidden |= beyond;
    }
    for (int i = 0; i < L::kCount; ++i)
      state[first + i] = std::uint8_t(forbidden >> i & 1 ? CellState::Forbidden
                                      : close >> i & 1   ? CellState::Close
                                                         : CellState::Allowed);
  }
}

}  // namespace
}  // namespace sinew
