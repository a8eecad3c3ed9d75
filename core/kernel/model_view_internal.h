#pragma once
#include <cstddef>

namespace sinew {

// What the compiled kernels see of a model: plain arrays of plain structures. This header is compiled for every
// instruction set, so it must not bring in anything inline from elsewhere (see README.md).

template <class Real>
struct JointView {
  enum Kind { Free, Ball, Revolute };
  int kind, parent, child, coordinate;  ///< parent -1 = world; coordinate of the first rotation
  bool turned;                          ///< R_PJ is not the identity
  Real R_PJ[9], p_PJ[3], axis[3];       ///< rows; axis of a revolute joint
};

template <class Real>
struct PatellaView {
  static constexpr int kMaxSamples = 32;
  int segment, femur, coordinate;
  Real R_FK[9], p_FK[3];
  Real radius_m, cos_start, sin_start;
  /// glide' = rate[0] + sum_i slope[i] min(max(knee - knot[i], 0), span[i]); glide is its integral from knot[0].
  int samples;  ///< intervals
  Real knot[kMaxSamples], span[kMaxSamples], rate[kMaxSamples + 1], slope[kMaxSamples];
};

template <class Real>
struct RadiusView {
  int segment, ulna, coordinate;  ///< first rotation of the wrist
  Real p_UR[3], axis[3];
};

/// One anchor of a path point, weighted beforehand: it adds R_WB (w x) + w t_WB.
template <class Real>
struct TermView {
  Real wx, wy, wz, w;
};

/// A segment that a unit spans: the wrench on it (and what hangs on it) turns its joint.
struct NodeView {
  enum Kind { Ball, Revolute, Patella, Radius };
  int kind;
  int segment;
  int driver;       ///< which patella or radius
  int parent_slot;  ///< slot of the segment that it hangs on, -1 if that is where the unit's wrenches cancel
  int entry;        ///< first entry of the unit's gradient that it writes
  bool adds;        ///< the entry has a value already (knee: patella and tibia; wrist: radius and hand)
};

template <class Real>
struct ModelView {
  int joint_count, segment_count, unit_count, entry_count;
  const JointView<Real>* joints;
  const PatellaView<Real>* patellae;  ///< 2
  const RadiusView<Real>* radii;      ///< 2
  const Real* unit_constant_m;        ///< length of the segments of the path that lie on one bone
  const int* unit_runs;               ///< unit_count + 1; a run is a piece of path whose segments all change
  const int* run_points;              ///< runs + 1
  const int* point_terms;             ///< points + 1
  const TermView<Real>* terms;
  const int* term_offset;  ///< 12 * segment
  const int* term_slot;    ///< node of the unit, -1 = the segment where the wrenches cancel
  const int* unit_nodes;   ///< unit_count + 1; leaves first
  const NodeView* nodes;
  int group_count;
  const int* group_units;     ///< group_count + 1; units whose gradients are worked on together
  int max_points, max_terms;  ///< of one group
  int max_nodes;              ///< of one unit
};

/// Registers that a kernel needs as working memory.
template <class Real>
constexpr std::size_t scratchRegisters(const ModelView<Real>& m) {
  return static_cast<std::size_t>(m.segment_count * (12 + 9) + m.max_points * 7 + m.max_terms * 3 + m.max_nodes * 6);
}

}  // namespace sinew
