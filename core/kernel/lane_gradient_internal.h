#pragma once
#include "core/kernel/lane_lengths_internal.h"

// dl/dq by wrench transpose. A unit under unit tension pulls its point i with g_i = u_(i-1) - u_i (unit vectors along
// the segments of the path before and after it): that is dl/dp_i. Each anchor passes w g on to its segment: a force
// and a moment about the world's origin. The wrench of a segment is passed on to the one that it hangs on, leaves
// first, up to where all wrenches of the unit cancel; on the way each joint takes the part of the wrench about its
// axes. The same weights that make the length share the force, so that no work is lost.

namespace sinew {
namespace {

// Square roots and divisions take long but can overlap. So units are worked on in groups: first all points, then all
// unit vectors of the group, then each unit's wrenches.

/// Working memory; arrays by point and by anchor count from the first of the group.
template <class L>
struct GradientScratch {
  typename L::V *X, *rates;     ///< of the segments
  Vector3Of<L>*point, *ahead;   ///< of the path; unit vector from the point to the next of its run
  typename L::V* distance;      ///< to the next
  Vector3Of<L>* term;           ///< anchors of blended points, weighted, in the world
  typename L::V* wrench;        ///< by node of the unit: force, moment
  int first_point, first_term;  ///< of the group
};

/// A point of the path; where it is blended, its anchors are kept.
template <class L>
inline Vector3Of<L> keptPoint(const ModelView<double>& m, int point, const GradientScratch<L>& s) {
  const int first = m.point_terms[point], end = m.point_terms[point + 1];
  if (end - first == 1) return single<L>(m.terms[first], s.X + m.term_offset[first]);
  Vector3Of<L> p{L::set(0), L::set(0), L::set(0)};
  for (int t = first; t < end; ++t) {
    const Vector3Of<L> more = weighted<L>(m.terms[t], s.X + m.term_offset[t]);
    s.term[t - s.first_term] = more;
    p.x += more.x, p.y += more.y, p.z += more.z;
  }
  return p;
}

/// Points, distances and unit vectors of a group of units.
template <class L>
void groupDirections(const ModelView<double>& m, int first_unit, int end_unit, const GradientScratch<L>& s) {
  using V = typename L::V;
  const V zero = L::set(0), one = L::set(1);
  const int end_run = m.unit_runs[end_unit], end_point = m.run_points[end_run];
  for (int p = s.first_point; p < end_point; ++p) s.point[p - s.first_point] = keptPoint<L>(m, p, s);
  for (int run = m.unit_runs[first_unit]; run < end_run; ++run)
    for (int i = m.run_points[run] - s.first_point; i < m.run_points[run + 1] - 1 - s.first_point; ++i) {
      const Vector3Of<L>&a = s.point[i], &b = s.point[i + 1];
      const V dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
      const V square = dx * dx + dy * dy + dz * dz, distance = L::sqrt(square);
      // Two points in one place pull in no direction.
      const V inverse = square > zero ? one / distance : zero;
      s.distance[i] = distance;
      s.ahead[i] = {dx * inverse, dy * inverse, dz * inverse};
    }
}

/// The pull g on a point, handed to the segments of its anchors.
template <class L>
inline void addPull(const ModelView<double>& m, int point, const Vector3Of<L>& g, const GradientScratch<L>& s) {
  const int first = m.point_terms[point], end = m.point_terms[point + 1];
  const bool blended = end - first > 1;
  for (int t = first; t < end; ++t) {
    if (m.term_slot[t] < 0) continue;
    const double w = m.terms[t].w;
    const Vector3Of<L>& r = blended ? s.term[t - s.first_term] : s.point[point - s.first_point];  // weighted
    typename L::V* wrench = s.wrench + 6 * m.term_slot[t];
    wrench[0] += g.x * w, wrench[1] += g.y * w, wrench[2] += g.z * w;
    wrench[3] += r.y * g.z - r.z * g.y, wrench[4] += r.z * g.x - r.x * g.z, wrench[5] += r.x * g.y - r.y * g.x;
  }
}

/// Wrenches of the unit's nodes; returns its length.
template <class L>
inline typename L::V unitWrenches(const ModelView<double>& m, int unit, const GradientScratch<L>& s) {
  for (int i = 0; i < 6 * (m.unit_nodes[unit + 1] - m.unit_nodes[unit]); ++i) s.wrench[i] = L::set(0);
  typename L::V length = L::set(m.unit_constant_m[unit]);
  for (int run = m.unit_runs[unit]; run < m.unit_runs[unit + 1]; ++run) {
    const int last = m.run_points[run + 1] - 1;
    Vector3Of<L> behind{L::set(0), L::set(0), L::set(0)};
    for (int p = m.run_points[run]; p < last; ++p) {
      const Vector3Of<L>& u = s.ahead[p - s.first_point];
      addPull<L>(m, p, {behind.x - u.x, behind.y - u.y, behind.z - u.z}, s);
      length += s.distance[p - s.first_point];
      behind = u;
    }
    addPull<L>(m, last, behind, s);
  }
  return length;
}

/// Writes or adds one entry of the gradient.
template <class L>
inline void put(double* entry, typename L::V value, bool adds) {
  L::store(entry, adds ? L::load(entry) + value : value);
}

/// What one node's joint takes of its wrench. `entries`: the unit's gradient in lanes, `stride` from one to the next.
template <class L>
inline void projectNode(const NodeView& node, const typename L::V* w, const GradientScratch<L>& s, double* entries,
                        std::size_t stride) {
  using V = typename L::V;
  const V* D = s.rates + 9 * node.segment;
  double* entry = entries + node.entry * stride;
  // Moment about a point of the axis: the segment's origin, or the centre of the patella's circle.
  const V* X = s.X + 12 * node.segment;
  const bool patella = node.kind == NodeView::Patella;
  const V ox = patella ? D[3] : X[3], oy = patella ? D[4] : X[7], oz = patella ? D[5] : X[11];
  const V mx = w[3] - (oy * w[2] - oz * w[1]), my = w[4] - (oz * w[0] - ox * w[2]),
          mz = w[5] - (ox * w[1] - oy * w[0]);
  const V about = D[0] * mx + D[1] * my + D[2] * mz;
  switch (node.kind) {
    case NodeView::Ball:
      put<L>(entry, about, node.adds);
      put<L>(entry + stride, D[3] * mx + D[4] * my + D[5] * mz, node.adds);
      put<L>(entry + 2 * stride, D[6] * mx + D[7] * my + D[8] * mz, node.adds);
      break;
    case NodeView::Radius:
      for (int i = 0; i < 3; ++i) put<L>(entry + i * stride, about * D[3 + i], node.adds);
      break;
    default:  // Revolute, Patella
      put<L>(entry, about, node.adds);
  }
}

/// Length of one unit; its gradient goes to `entries`.
template <class L>
inline typename L::V unitGradient(const ModelView<double>& m, int unit, const GradientScratch<L>& s, double* entries,
                                  std::size_t stride) {
  const typename L::V length = unitWrenches<L>(m, unit, s);
  const NodeView* nodes = m.nodes + m.unit_nodes[unit];
  const int count = m.unit_nodes[unit + 1] - m.unit_nodes[unit];
  for (int i = 0; i < count; ++i) {
    const typename L::V* w = s.wrench + 6 * i;
    projectNode<L>(nodes[i], w, s, entries, stride);
    if (nodes[i].parent_slot >= 0)
      for (int c = 0; c < 6; ++c) s.wrench[6 * nodes[i].parent_slot + c] += w[c];
  }
  return length;
}

}  // namespace
}  // namespace sinew
