#pragma once
#include "core/kernel/lanes_internal.h"

// Rotations in lanes without a library's sine and cosine. A turn v enters only through even functions of t = |v|:
//   R = I + a [v] + b [v]^2,  a = sin t / t,  b = (1 - cos t) / t^2,
// and with c = cos(t/2), s = sin(t/2) / t these are a = 2 c s, b = 2 s^2: two power series in t^2, no square root and
// no special case at zero. The series are for |t| <= pi, where a posture's turns lie; a lane beyond is brought back.

namespace sinew {
namespace {

template <class Real>
constexpr int kSeriesTerms = sizeof(Real) == 8 ? 11 : 7;  // remainder at pi below half a unit in the last place
constexpr double kLargestSquare = 9.9;                    // of t; a little above pi^2

template <int kFirst, int kTerms>
struct FactorialCoefficients {
  double value[kTerms];
  constexpr FactorialCoefficients() : value{} {
    double factorial = 1;
    for (int i = 2; i <= kFirst; ++i) factorial *= i;
    for (int k = 0; k < kTerms; ++k) {
      value[k] = (k % 2 ? -1 : 1) / factorial;
      factorial *= (2 * k + kFirst + 1) * (2 * k + kFirst + 2);
    }
  }
};

/// sum_k (-x)^k / (2 k + kFirst)!
template <class L, int kFirst, int kTerms = kSeriesTerms<typename L::Real>>
inline typename L::V factorialSeries(typename L::V x) {
  static constexpr FactorialCoefficients<kFirst, kTerms> kCoefficients;
  typename L::V sum = L::set(typename L::Real(kCoefficients.value[kTerms - 1]));
  for (int k = kTerms - 2; k >= 0; --k) sum = sum * x + typename L::Real(kCoefficients.value[k]);
  return sum;
}

/// Half of a turn by t: the quaternion is (c, s v).
template <class L>
struct HalfTurn {
  typename L::V c, s;
};

template <class L>
HalfTurn<L> halfTurn(typename L::V square) {
  using V = typename L::V;
  using Real = typename L::Real;
  const V quarter = square * Real(0.25);
  HalfTurn<L> half{factorialSeries<L, 0>(quarter), factorialSeries<L, 1>(quarter) * Real(0.5)};
  const auto beyond = square > Real(kLargestSquare);
  if (__builtin_expect(L::bits(beyond) != 0, 0)) {
    constexpr double kTurn = 6.283185307179586, kTurnRest = 2.4492935982947064e-16;     // 2 pi in two pieces
    constexpr Real kRound = Real(sizeof(Real) == 8 ? 6755399441055744.0 : 12582912.0);  // adding it rounds
    const V t = L::sqrt(square);
    const V turns = (t * Real(1 / kTurn) + kRound) - kRound;
    const V rest = ((t - turns * Real(kTurn)) - turns * Real(kTurnRest)) * Real(0.5);
    const V rest2 = rest * rest;
    half.c = beyond ? factorialSeries<L, 0>(rest2) : half.c;
    half.s = beyond ? rest * factorialSeries<L, 1>(rest2) / t : half.s;
  }
  return half;
}

/// R = I + a [v] + b [v]^2, rows.
template <class L>
void rotation(typename L::V x, typename L::V y, typename L::V z, typename L::V a, typename L::V b, typename L::V* R) {
  using V = typename L::V;
  const V one = L::set(1), bx = b * x, by = b * y, bz = b * z, ax = a * x, ay = a * y, az = a * z;
  const V xx = bx * x, yy = by * y, zz = bz * z, xy = bx * y, xz = bx * z, yz = by * z;
  R[0] = one - (yy + zz), R[1] = xy - az, R[2] = xz + ay;
  R[3] = xy + az, R[4] = one - (xx + zz), R[5] = yz - ax;
  R[6] = xz - ay, R[7] = yz + ax, R[8] = one - (xx + yy);
}

/// Turn by an angle about a constant unit axis, from its sine and 1 - cosine.
template <class L>
void rotationAboutAxis(const typename L::Real* axis, typename L::V sine, typename L::V versine, typename L::V* R) {
  const auto x = axis[0], y = axis[1], z = axis[2];
  const typename L::V sx = sine * x, sy = sine * y, sz = sine * z;
  R[0] = 1 - versine * (y * y + z * z), R[1] = versine * (x * y) - sz, R[2] = versine * (x * z) + sy;
  R[3] = versine * (x * y) + sz, R[4] = 1 - versine * (x * x + z * z), R[5] = versine * (y * z) - sx;
  R[6] = versine * (x * z) - sy, R[7] = versine * (y * z) + sx, R[8] = 1 - versine * (x * x + y * y);
}

/// (t - sin t) / t^3, the third coefficient of the derivative of the exponential map; a = sin t / t.
template <class L>
typename L::V thirdCoefficient(typename L::V square, typename L::V a) {
  using Real = typename L::Real;
  const typename L::V series = factorialSeries<L, 3, kSeriesTerms<Real> + 2>(square);
  const auto beyond = square > Real(kLargestSquare);
  if (__builtin_expect(L::bits(beyond) != 0, 0)) return beyond ? (1 - a) / square : series;
  return series;
}

}  // namespace
}  // namespace sinew
