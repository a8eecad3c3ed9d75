#include "core/muscle/hill.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/muscle/musculature.h"
#include "core/optimization/bracketed_root.h"

namespace sinew {
namespace {

constexpr double kTendonToeShape = 3;                    // k_toe
constexpr double kTendonToeForce = 0.33;                 // F_toe
constexpr double kCurvature = 0.25;                      // A_f
constexpr double kLongest = 1.6, kLongestTendon = 1.03;  // k_m, k_t of Ryu et al.

/// scale (exp(k x) - 1): 0 at 0; 1 at 1 with scale = 1 / (exp(k) - 1).
CurveValue scaledExponential(double scale, double k, double x) {
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

namespace {
const HillCurves& published() {
  static const HillCurves curves{HillParameters{}};
  return curves;
}
}  // namespace

HillCurves::HillCurves(const HillParameters& parameters)
    : p_{parameters}, passive_scale_{1 / std::expm1(parameters.passive_shape)} {}

CurveValue HillCurves::active(double l) const {
  const double f = std::exp(-(l - 1) * (l - 1) / p_.active_width);
  return {f, -2 * (l - 1) / p_.active_width * f};
}

CurveValue HillCurves::passive(double l) const {
  const auto exponential = [&](double x) { return scaledExponential(passive_scale_, p_.passive_shape, x); };
  const CurveValue f = withRoundedOnset((l - 1) / p_.passive_strain, 0.05, exponential);
  return {f.value, f.slope / p_.passive_strain};
}

CurveValue HillCurves::tendon(double l_t) const {
  // The toe ends where the slopes of both pieces meet; Thelen's rounded figures are 0.609 and 1.712.
  static const double toe_slope = kTendonToeForce * kTendonToeShape / -std::expm1(-kTendonToeShape);
  static const double toe_end = toe_slope / (toe_slope + 1 - kTendonToeForce);
  static const double linear_slope = (1 - kTendonToeForce) / (1 - toe_end);
  static const double toe_scale = 1 / std::expm1(kTendonToeShape);
  const double x = (l_t - 1) / p_.tendon_strain;
  CurveValue f;
  if (x > toe_end) {
    f = {kTendonToeForce + linear_slope * (x - toe_end), linear_slope};
  } else {
    f = withRoundedOnset(x / toe_end, 0.05, [](double s) {
      const CurveValue toe = scaledExponential(toe_scale, kTendonToeShape, s);
      return CurveValue{kTendonToeForce * toe.value, kTendonToeForce * toe.slope};
    });
    f.slope /= toe_end;
  }
  return {f.value, f.slope / p_.tendon_strain};
}

CurveValue HillCurves::velocity(double velocity_1_s, double activation) const {
  const double fastest = (0.25 + 0.75 * activation) * p_.max_velocity_1_s;
  const double v = velocity_1_s / fastest;
  const auto shortening = [](double u) {
    const double d = 1 - u / kCurvature;
    return CurveValue{(1 + u) / d, (1 + 1 / kCurvature) / (d * d)};
  };
  const auto lengthening = [rise = p_.max_lengthening - 1](double u) {
    const double k = 2 + 2 / kCurvature, d = k * u + rise;
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

CurveValue activeForceLength(double l) {
  return published().active(l);
}
CurveValue passiveForceLength(double l) {
  return published().passive(l);
}
CurveValue tendonForceLength(double l_t) {
  return published().tendon(l_t);
}
CurveValue forceVelocity(double velocity_1_s, double activation) {
  return published().velocity(velocity_1_s, activation);
}

double longestLength_m(const MusculotendonUnit& unit) {
  constexpr HillParameters kPublished;
  const HillParameters& own = unit.curves;
  const double fiber = own.passive_strain == kPublished.passive_strain ? kLongest : 1 + own.passive_strain;
  const double tendon = own.tendon_strain == kPublished.tendon_strain
                            ? kLongestTendon
                            : 1 + (kLongestTendon - 1) * own.tendon_strain / kPublished.tendon_strain;
  return fiber * unit.optimal_fiber_length_m + tendon * unit.tendon_slack_length_m;
}

FiberState equilibrium(const MusculotendonUnit& unit, double length_m, double activation) {
  require(activation >= 0 && activation <= 1, "equilibrium: activation in [0, 1]");
  const double l0 = unit.optimal_fiber_length_m, slack = unit.tendon_slack_length_m;
  const double cosine = std::cos(unit.pennation_angle_at_optimal_rad);
  const HillCurves curves = unit.curves == HillParameters{} ? published() : HillCurves{unit.curves};
  const double taut = (length_m - slack) / (l0 * cosine);  // normalised fibre length with the tendon just slack
  const auto tendon = [&](double l) { return curves.tendon((length_m - l * l0 * cosine) / slack); };
  const auto fiber = [&](double l) {
    const CurveValue active = curves.active(l), passive = curves.passive(l);
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
  const double active_N = unit.max_isometric_force_N * activation * curves.active(l).value * cosine;
  state.active_force_N = std::min(state.force_N, active_N);
  return state;
}

}  // namespace sinew
