#pragma once
#include "core/kernel/lane_kinematics_internal.h"

namespace sinew {
namespace {

/// R (w x) + w t of one anchor, X = its segment's 12 registers.
template <class L>
inline Vector3Of<L> weighted(const TermView<typename L::Real>& t, const typename L::V* X) {
  return {X[3] * t.w + X[0] * t.wx + X[1] * t.wy + X[2] * t.wz, X[7] * t.w + X[4] * t.wx + X[5] * t.wy + X[6] * t.wz,
          X[11] * t.w + X[8] * t.wx + X[9] * t.wy + X[10] * t.wz};
}

/// The same of an anchor with weight 1, as most are.
template <class L>
inline Vector3Of<L> single(const TermView<typename L::Real>& t, const typename L::V* X) {
  return {X[3] + X[0] * t.wx + X[1] * t.wy + X[2] * t.wz, X[7] + X[4] * t.wx + X[5] * t.wy + X[6] * t.wz,
          X[11] + X[8] * t.wx + X[9] * t.wy + X[10] * t.wz};
}

template <class L>
inline Vector3Of<L> pathPoint(const ModelView<typename L::Real>& m, int point, const typename L::V* X) {
  const int first = m.point_terms[point], end = m.point_terms[point + 1];
  if (end - first == 1) return single<L>(m.terms[first], X + m.term_offset[first]);
  Vector3Of<L> p = weighted<L>(m.terms[first], X + m.term_offset[first]);
  for (int t = first + 1; t < end; ++t) {
    const Vector3Of<L> more = weighted<L>(m.terms[t], X + m.term_offset[t]);
    p.x += more.x, p.y += more.y, p.z += more.z;
  }
  return p;
}

/// Length of one unit at the poses X of its segments.
template <class L>
inline typename L::V unitLength(const ModelView<typename L::Real>& m, int unit, const typename L::V* X) {
  typename L::V length = L::set(m.unit_constant_m[unit]);
  for (int run = m.unit_runs[unit]; run < m.unit_runs[unit + 1]; ++run) {
    const int end = m.run_points[run + 1];
    Vector3Of<L> a = pathPoint<L>(m, m.run_points[run], X);
    for (int p = m.run_points[run] + 1; p < end; ++p) {
      const Vector3Of<L> b = pathPoint<L>(m, p, X);
      const typename L::V dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
      length += L::sqrt(dx * dx + dy * dy + dz * dz);
      a = b;
    }
  }
  return length;
}

}  // namespace
}  // namespace sinew
