#pragma once
#include <vector>

#include "core/kernel/compiled_model.h"
#include "core/kernel/kernel_table_internal.h"
#include "core/kernel/pose_table.h"

namespace sinew {

/// The numbers of a ModelView, in one precision.
template <class Real>
struct RealArrays {
  std::vector<JointView<Real>> joints;
  std::vector<PatellaView<Real>> patellae;
  std::vector<RadiusView<Real>> radii;
  std::vector<TermView<Real>> terms;
  std::vector<Real> unit_constant_m;
};

/// What a CompiledModel owns.
struct CompiledArrays {
  int segment_count = 0, coordinate_count = 0, max_points = 0, max_terms = 0, max_nodes = 0;
  RealArrays<double> doubles;
  RealArrays<float> floats;
  std::vector<int> group_units, unit_runs, run_points, point_terms, term_offset, term_slot, unit_nodes;
  std::vector<NodeView> nodes;
  std::vector<int> gradient_start, gradient_coordinate;
  std::vector<double> longest_m;

  template <class Real>
  ModelView<Real> view() const {
    const auto& r = [this]() -> const RealArrays<Real>& {
      if constexpr (sizeof(Real) == sizeof(double))
        return doubles;
      else
        return floats;
    }();
    return {static_cast<int>(r.joints.size()),
            segment_count,
            static_cast<int>(unit_runs.size()) - 1,
            static_cast<int>(gradient_coordinate.size()),
            r.joints.data(),
            r.patellae.data(),
            r.radii.data(),
            r.unit_constant_m.data(),
            unit_runs.data(),
            run_points.data(),
            point_terms.data(),
            r.terms.data(),
            term_offset.data(),
            term_slot.data(),
            unit_nodes.data(),
            nodes.data(),
            static_cast<int>(group_units.size()) - 1,
            group_units.data(),
            max_points,
            max_terms,
            max_nodes};
  }
};

const KernelTable& kernels(Isa isa);

/// Working memory of one thread's kernels.
class KernelScratch {
 public:
  explicit KernelScratch(const CompiledModel& model);
  void* get() { return memory_.data(); }

 private:
  LaneVector memory_;
};

}  // namespace sinew
