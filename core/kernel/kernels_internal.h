#pragma once
#include "core/kernel/kernel_table_internal.h"
#include "core/kernel/lane_gradient_internal.h"
#include "core/kernel/lane_grid_internal.h"

// The entries of a KernelTable, made from the lane_* headers for whatever instruction set this is compiled for.

namespace sinew {
namespace {

constexpr int kBlockPoses = 16;
constexpr PostureLanes lanesFrom(const double* q, int lane) {
  return {q + lane, kBlockPoses};
}

template <class L>
void blockPoses(const ModelView<double>& m, const double* q, void* scratch, double* X_WB) {
  auto* X = static_cast<typename L::V*>(scratch);
  for (int lane = 0; lane < kBlockPoses; lane += L::kCount) {
    lanePoses<L, true, false>(m, lanesFrom(q, lane), X, nullptr);
    for (int i = 0; i < 12 * m.segment_count; ++i) L::store(X_WB + i * kBlockPoses + lane, X[i]);
  }
}

template <class L>
void blockLengths(const ModelView<typename L::Real>& m, const double* q, void* scratch, double* lengths_m) {
  auto* X = static_cast<typename L::V*>(scratch);
  for (int lane = 0; lane < kBlockPoses; lane += L::kCount) {
    lanePoses<L, false, false>(m, lanesFrom(q, lane), X, nullptr);
    for (int u = 0; u < m.unit_count; ++u) L::store(lengths_m + u * kBlockPoses + lane, unitLength<L>(m, u, X));
  }
}

template <class L>
GradientScratch<L> gradientScratch(const ModelView<double>& m, void* scratch) {
  using V = typename L::V;
  using Vector = Vector3Of<L>;
  static_assert(sizeof(Vector) == 3 * sizeof(V));
  V* X = static_cast<V*>(scratch);
  V* rates = X + 12 * m.segment_count;
  V* point = rates + 9 * m.segment_count;
  V* ahead = point + 3 * m.max_points;
  V* distance = ahead + 3 * m.max_points;
  V* term = distance + m.max_points;
  V* wrench = term + 3 * m.max_terms;
  return {X,
          rates,
          reinterpret_cast<Vector*>(point),
          reinterpret_cast<Vector*>(ahead),
          distance,
          reinterpret_cast<Vector*>(term),
          wrench,
          0,
          0};
}

template <class L>
void laneGradients(const ModelView<double>& m, PostureLanes q, void* scratch, double* lengths_m, double* gradients,
                   std::size_t stride) {
  GradientScratch<L> s = gradientScratch<L>(m, scratch);
  lanePoses<L, false, true>(m, q, s.X, s.rates);
  for (int group = 0; group < m.group_count; ++group) {
    const int first = m.group_units[group], end = m.group_units[group + 1];
    s.first_point = m.run_points[m.unit_runs[first]];
    s.first_term = m.point_terms[s.first_point];
    groupDirections<L>(m, first, end, s);
    for (int u = first; u < end; ++u) L::store(lengths_m + u * stride, unitGradient<L>(m, u, s, gradients, stride));
  }
}

template <class L>
void blockGradients(const ModelView<double>& m, const double* q, void* scratch, double* lengths_m,
                    double* gradients) {
  for (int lane = 0; lane < kBlockPoses; lane += L::kCount)
    laneGradients<L>(m, lanesFrom(q, lane), scratch, lengths_m + lane, gradients + lane, kBlockPoses);
}

inline void singleGradients(const ModelView<double>& m, const double* q, void* scratch, double* lengths_m,
                            double* gradients) {
  laneGradients<Lanes<double, 1>>(m, {q, 1}, scratch, lengths_m, gradients, 1);
}

/// Poses of one register that are longer than the longest so far: few, so they are looked at one by one.
template <class L>
void keepLongest(typename L::V length, unsigned longer, long first_pose, double& longest_m, long& longest_pose) {
  for (; longer != 0; longer &= longer - 1) {
    const int i = __builtin_ctz(longer);
    if (double(length[i]) > longest_m) longest_m = double(length[i]), longest_pose = first_pose + i;
  }
}

template <class L>
void sweepBlock(const ModelView<typename L::Real>& m, const double* q, int poses, long first_pose, void* scratch,
                const double* limit_m, double* longest_m, long* longest_pose, std::uint8_t* valid) {
  using V = typename L::V;
  using Real = typename L::Real;
  const Real close_m = sizeof(Real) == sizeof(double) ? Real(0) : Real(GridView::kClose_m);
  auto* X = static_cast<V*>(scratch);
  for (int lane = 0; lane < poses; lane += L::kCount) {
    const unsigned present = poses - lane >= L::kCount ? ~0u : (1u << (poses - lane)) - 1;
    lanePoses<L, false, false>(m, lanesFrom(q, lane), X, nullptr);
    auto beyond = X[0] < X[0], close = beyond;
    for (int u = 0; u < m.unit_count; ++u) {
      const V length = unitLength<L>(m, u, X);
      const unsigned longer = L::bits(length > L::set(Real(longest_m[u]))) & present;
      if (__builtin_expect(longer != 0, 0))
        keepLongest<L>(length, longer, first_pose + lane, longest_m[u], longest_pose[u]);
      const V over = length - Real(limit_m[u]);
      beyond |= over > close_m;
      close |= over > -close_m;
    }
    const unsigned beyond_bits = L::bits(beyond), close_bits = L::bits(close);
    for (int i = 0; i < L::kCount && lane + i < poses; ++i)
      valid[lane + i] = std::uint8_t(beyond_bits >> i & 1  ? CellState::Forbidden
                                     : close_bits >> i & 1 ? CellState::Close
                                                           : CellState::Allowed);
  }
}

template <int kBytes>
constexpr KernelTable kernelTable() {
  using Double = Lanes<double, kBytes / 8>;
  using Float = Lanes<float, kBytes / 4>;
  return {Double::kCount,         Float::kCount,   blockPoses<Double>, blockLengths<Double>, blockLengths<Float>,
          blockGradients<Double>, singleGradients, sweepBlock<Double>, sweepBlock<Float>,    laneGrid<Float>};
}

}  // namespace
}  // namespace sinew
