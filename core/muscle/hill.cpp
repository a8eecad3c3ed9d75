#include "core/muscle/hill.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/muscle/musculature.h"

namespace sinew {
namespace {

constexpr double kActiveWidth = 0.45;                    // gamma of Thelen 2003, table 1
constexpr double kPassiveStrain = 0.6;                   // strain at which passive force is F_max (young adults)
constexpr double kPassiveShape = 5;                      // k_PE
constexpr double kTendonStrain = 0.033;                  // strain at which tendon force is F_max
constexpr double kTendonToeShape = 3;                    // k_toe
constexpr double kTendonToeForce = 0.33;                 // F_toe
constexpr double kCurvature = 0.25;                      // A_f
constexpr double kMaxLengthening = 1.4;                  // F_len
constexpr double kMaxVelocity_1_s = 10;                  // V_max
constexpr double kLongest = 1.6, kLongestTendon = 1.03;  // k_m, k_t of Ryu et al.

/// (exp(k x) - 1) / (exp(k) - 1): 0 at 0, 1 at 1.
CurveValue normalizedExponential(double k, double x) {
  const double scale = 1 / std::expm1(k);
  return {scale * std::expm1(k * x), scale * k * std::exp(k * x)};
}

/// Cubic from (x0, start) to (x1, end) with the slopes of both ends.
CurveValue hermite(double x0, CurveValue start, double x1, CurveValue end, double x) {
  const double h = x1 - x0, t = (x - x0) / h;
  const double rise = end.value - start.value, m0 = h * start.slope, m1 = h * end.slope;
  const double c2 = 3 * rise - 2 * m0 - m1, c3 = m0 + m1 - 2 * rise;
  return {start.value + t * (m0 + t * (c2 + t * c3)), (m0 + t * (2 * c2 + t * 3 * c3)) / h};
}

/// A curve that is 0 up to x = 0 and `published` after, with the corner rounded off over [0, width].
template <class Curve>
CurveValue withRoundedOnset(double x, double width, const Curve& published) {
  if (x <= 0) return {};
  return x >= width ? published(x) : hermite(0, {}, width, published(width), x);
}

}  // namespace

CurveValue activeForceLength(double l) {
  const double f = std::exp(-(l - 1) * (l - 1) / kActiveWidth);
  return {f, -2 * (l - 1) / kActiveWidth * f};
}

CurveValue passiveForceLength(double l) {
  const auto published = [](double x) { return normalizedExponential(kPassiveShape, x); };
  const CurveValue f = withRoundedOnset((l - 1) / kPassiveStrain, 0.05, published);
  return {f.value, f.slope / kPassiveStrain};
}

CurveValue tendonForceLength(double l_t) {
  // The toe ends where the slopes of both pieces meet; Thelen's rounded figures are 0.609 and 1.712.
  static const double toe_slope = kTendonToeForce * kTendonToeShape / -std::expm1(-kTendonToeShape);
  static const double toe_end = toe_slope / (toe_slope + 1 - kTendonToeForce);
  static const double linear_slope = (1 - kTendonToeForce) / (1 - toe_end);
  const double x = (l_t - 1) / kTendonStrain;
  CurveValue f;
  if (x > toe_end) {
    f = {kTendonToeForce + linear_slope * (x - toe_end), linear_slope};
  } else {
    f = withRoundedOnset(x / toe_end, 0.05, [](double s) {
      const CurveValue toe = normalizedExponential(kTendonToeShape, s);
      return CurveValue{kTendonToeForce * toe.value, kTendonToeForce * toe.slope};
    });
    f.slope /= toe_end;
  }
  return {f.value, f.slope / kTendonStrain};
}

CurveValue forceVelocity(double velocity_1_s, double activation) {
  const double fastest = (0.25 + 0.75 * activation) * kMaxVelocity_1_s;
  const double v = velocity_1_s / fastest;
  const auto shortening = [](double u) {
    const double d = 1 - u / kCurvature;
    return CurveValue{(1 + u) / d, (1 + 1 / kCurvature) / (d * d)};
  };
  const auto lengthening = [](double u) {
    const double k = 2 + 2 / kCurvature, rise = kMaxLengthening - 1, d = k * u + rise;
    return CurveValue{1 + k * u * rise / d, k * rise * rise / (d * d)};
  };
  constexpr double kIsometricRound = 0.02, kFastestRound = 0.1;  // of the fastest velocity
  CurveValue f;
  if (v <= -1) {
    f = {};
  } else if (v < -1 + kFastestRound) {
    f = hermite(-1, {}, -1 + kFastestRound, shortening(-1 + kFastestRound), v);
  } else if (v <= 0) {
    f = shortening(v);
  } else if (v < kIsometricRound) {
    f = hermite(0, shortening(0), kIsometricRound, lengthening(kIsometricRound), v);
  } else {
    f = lengthening(v);
  }
  return {f.value, f.slope / fastest};
}

double longestLength_m(const MusculotendonUnit& unit) {
  return kLongest * unit.optimal_fiber_length_m + kLongestTendon * unit.tendon_slack_length_m;
}

namespace {

/// Root in [low, high] of an imbalance that is <= 0 at low and >= 0 at high: Newton, bisected where it leaves the
/// bracket or gains too little.
template <class Function>
double bracketedRoot(double low, double high, const Function& imbalance) {
  double x = 0.5 * (low + high);
  double last_width = high - low;
  for (int i = 0; i < 100 && high - low > 1e-14; ++i) {
    const CurveValue g = imbalance(x);
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

}  // namespace

FiberState equilibrium(const MusculotendonUnit& unit, double length_m, double activation) {
  require(activation >= 0 && activation <= 1, "equilibrium: activation in [0, 1]");
  const double l0 = unit.optimal_fiber_length_m, slack = unit.tendon_slack_length_m;
  const double cosine = std::cos(unit.pennation_angle_at_optimal_rad);
  const double taut = (length_m - slack) / (l0 * cosine);  // normalised fibre length with the tendon just slack
  const auto tendon = [&](double l) { return tendonForceLength((length_m - l * l0 * cosine) / slack); };
  const auto fiber = [&](double l) {
    const CurveValue active = activeForceLength(l), passive = passiveForceLength(l);
    return CurveValue{(activation * active.value + passive.value) * cosine,
                      (activation * active.slope + passive.slope) * cosine};
  };

  FiberState state;
  double l = std::max(taut, kShortestFiber);
  const bool carries = taut > kShortestFiber && (activation > 0 || taut > 1);
  if (carries && tendon(kShortestFiber).value > fiber(kShortestFiber).value) {
    l = bracketedRoot(kShortestFiber, taut, [&](double x) {
      const CurveValue f = fiber(x), t = tendon(x);
      return CurveValue{f.value - t.value, f.slope + t.slope * l0 * cosine / slack};
    });
  } else if (carries) {
    l = kShortestFiber;  // the fibre could pull harder than the tendon is stretched at its shortest
  }
  state.normalized_fiber_length = l;
  state.fiber_length_m = l * l0;
  state.tendon_length_m = std::max(length_m - l * l0 * cosine, slack);
  if (carries) state.force_N = unit.max_isometric_force_N * tendon(l).value;
  state.slack = !(state.force_N > 0);
  const double active_N = unit.max_isometric_force_N * activation * activeForceLength(l).value * cosine;
  state.active_force_N = std::min(state.force_N, active_N);
  return state;
}

}  // namespace sinew
