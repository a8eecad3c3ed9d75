#include <cmath>

#include "core/retarget/peaks/fiber_table_internal.h"

namespace sinew {
namespace {

/// How long a tendon is that pulls with `force` > 0. Newton on a convex curve: after one step from above.
CurveValue stretched(const HillCurves& curves, double force, double from) {
  constexpr int kMost = 50;
  double x = from;
  CurveValue tendon;
  for (int i = 0; i < kMost; ++i) {
    tendon = curves.tendon(x);
    const double step = (tendon.value - force) / tendon.slope;
    x -= step;
    if (std::abs(step) < 1e-12) break;
  }
  return {x, 1 / tendon.slope};
}

}  // namespace

FiberTable::FiberTable(const HillParameters& parameters, double cosine) : curves_{parameters}, cosine_{cosine} {
  const HillCurves curves{parameters};
  double longest = 1 + parameters.tendon_strain;
  for (int i = 0; i <= kLastCell + 1; ++i) {
    const double l = kFirst + i / kCells;
    const CurveValue active = curves.active(l), passive = curves.passive(l);
    const CurveValue tendon = stretched(curves, (active.value + passive.value) * cosine, longest);
    longest = tendon.value;
    nodes_.push_back({{tendon.value, tendon.slope * (active.slope + passive.slope) * cosine},
                      {active.value * cosine, active.slope * cosine}});
  }
}

}  // namespace sinew
