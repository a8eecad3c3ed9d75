#pragma once
#include <cmath>

namespace sinew {

/// Root in [low, high] of a function that is <= 0 at low and >= 0 at high and returns {value, slope}: Newton,
/// bisected where it leaves the bracket or gains too little. Ends when the bracket or the step is below 1e-14.
template <class Function>
double bracketedRoot(double low, double high, const Function& imbalance) {
  double x = 0.5 * (low + high);
  double last_width = high - low;
  for (int i = 0; i < 100 && high - low > 1e-14; ++i) {
    const auto g = imbalance(x);
    if (g.value == 0) return x;
    (g.value < 0 ? low : high) = x;
    double next = x - g.value / g.slope;
    const bool stalls = i % 4 == 3 && high - low > 0.5 * last_width;
    if (i % 4 == 3) last_width = high - low;
    if (!(next > low && next < high) || stalls) next = 0.5 * (low + high);
    if (std::abs(next - x) < 1e-14) return next;
    x = next;
  }
  return x;
}

}  // namespace sinew
