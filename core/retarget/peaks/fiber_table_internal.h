#pragma once
#include <vector>

#include "core/muscle/hill.h"

namespace sinew {

/// Static equilibrium of a fully active unit, tabulated over its fibre length: a length of the fibre says its force,
/// hence how far the tendon is stretched. Depends on curves and pennation alone; so the units of a body share few.
class FiberTable {
 public:
  /// Normalised fibre lengths that it is for.
  static constexpr double kFirst = kShortestFiber, kLast = 2;

  FiberTable(const HillParameters& curves, double cosine);
  bool isOf(const HillParameters& curves, double cosine) const { return curves_ == curves && cosine_ == cosine; }

  struct Entry {
    CurveValue tendon;  ///< normalised length; slope with that of the fibre
    CurveValue active;  ///< share of the active element in the force along the tendon, in F_max
  };
  /// `normalized_fiber_length` in [kFirst, kLast]. Off by less than 1e-7.
  Entry at(double normalized_fiber_length) const {
    const double place = (normalized_fiber_length - kFirst) * kCells;
    const int cell = place < kLastCell ? static_cast<int>(place) : kLastCell;
    const double t = place - cell;
    const Entry &from = nodes_[static_cast<std::size_t>(cell)], &to = nodes_[static_cast<std::size_t>(cell) + 1];
    return {between(from.tendon, to.tendon, t), between(from.active, to.active, t)};
  }

 private:
  static constexpr double kCells = 64;  // in an optimal length
  static constexpr int kLastCell = static_cast<int>((kLast - kFirst) * kCells);

  /// Cubic over one cell.
  static CurveValue between(CurveValue from, CurveValue to, double t) {
    const double rise = to.value - from.value, m0 = from.slope / kCells, m1 = to.slope / kCells;
    const double c2 = 3 * rise - 2 * m0 - m1, c3 = m0 + m1 - 2 * rise;
    return {from.value + t * (m0 + t * (c2 + t * c3)), (m0 + t * (2 * c2 + t * 3 * c3)) * kCells};
  }

  HillParameters curves_;
  double cosine_;
  std::vector<Entry> nodes_;
};

}  // namespace sinew
