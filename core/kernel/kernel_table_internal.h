#pragma once
#include <cstddef>
#include <cstdint>

#include "core/kernel/grid_view_internal.h"
#include "core/kernel/model_view_internal.h"

namespace sinew {

/// The kernels of one instruction set. Tables are in blocks of 16 poses (PoseTable); `scratch` has room for
/// scratchRegisters() of 64 bytes, aligned to 64.
struct KernelTable {
  int double_lanes, float_lanes;

  /// X_WB of one block of postures `q`: 12 entries a segment, rows [R p].
  void (*poses)(const ModelView<double>& m, const double* q, void* scratch, double* X_WB);
  /// Lengths of one block of postures.
  void (*lengths)(const ModelView<double>& m, const double* q, void* scratch, double* lengths_m);
  /// The same, computed in single precision.
  void (*lengths_float)(const ModelView<float>& m, const double* q, void* scratch, double* lengths_m);
  /// Lengths and dl/dq (entries of the pattern) of one block of postures.
  void (*gradients)(const ModelView<double>& m, const double* q, void* scratch, double* lengths_m, double* gradients);
  /// The same of one posture alone; plain arrays.
  void (*single_gradients)(const ModelView<double>& m, const double* q, void* scratch, double* lengths_m,
                           double* gradients);
  /// Longest length of every unit over the first `poses` postures of one block, where longer than longest_m, with the
  /// pose's number counted from `first_pose`; and for each pose whether no unit is longer than limit_m.
  void (*sweep)(const ModelView<double>& m, const double* q, int poses, long first_pose, void* scratch,
                const double* limit_m, double* longest_m, long* longest_pose, std::uint8_t* valid);
  void (*sweep_float)(const ModelView<float>& m, const double* q, int poses, long first_pose, void* scratch,
                      const double* limit_m, double* longest_m, long* longest_pose, std::uint8_t* valid);
  /// One twist of a range-of-motion grid.
  void (*grid)(const GridView& g, std::uint8_t* state);
};

extern const KernelTable kKernelsBaseline;
extern const KernelTable kKernelsV3, kKernelsV4;  ///< only where the processor is an x86-64

}  // namespace sinew
