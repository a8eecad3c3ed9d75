#pragma once
#include <memory>
#include <span>

#include "core/kernel/isa.h"
#include "core/muscle/musculature.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

struct CompiledArrays;

/// A skeleton and its musculature in the form that the kernels read: constant, cheap to copy, to be shared between
/// threads. Compiling takes about as long as a hundred postures with the readable code.
class CompiledModel {
 public:
  explicit CompiledModel(const Skeleton& skeleton, const Musculature& musculature, Isa isa = chosenIsa());

  Isa isa() const { return isa_; }
  int unitCount() const;
  int segmentCount() const;
  int coordinateCount() const;
  /// Longest length by unit, 1.6 l0 + 1.03 l_slack [m].
  std::span<const double> longest_m() const;

  /// Which dl/dq are not zero by construction, as compressed rows: entries of unit u are those from
  /// gradientStart()[u] to gradientStart()[u + 1], about the coordinates gradientCoordinate()[entry], ascending. The
  /// root never is: a body as a whole stretches no muscle.
  std::span<const int> gradientStart() const;
  std::span<const int> gradientCoordinate() const;

  const CompiledArrays& arrays() const { return *arrays_; }

 private:
  std::shared_ptr<const CompiledArrays> arrays_;
  Isa isa_;
};

}  // namespace sinew
