#pragma once
#include <cstddef>
#ifdef __SSE2__
#include <immintrin.h>
#endif

// One register of lanes, each lane another pose. Everything here and in the other lane_* headers lives in an unnamed
// namespace and uses nothing inline from elsewhere: a function compiled for a new processor must never be the one
// that the linker keeps for an old one.

namespace sinew {
namespace {

template <class R, int N>
struct Lanes {
  using Real = R;
  static constexpr int kCount = N;
  typedef R V __attribute__((vector_size(N * sizeof(R)), may_alias));
  typedef double Doubles __attribute__((vector_size(N * sizeof(double)), may_alias));

  static V set(R value) { return V{} + value; }
  /// From a table of doubles, aligned for the lanes.
  static V load(const double* p) {
    if constexpr (sizeof(R) == sizeof(double))
      return *reinterpret_cast<const V*>(p);
    else
      return __builtin_convertvector(*reinterpret_cast<const Doubles*>(p), V);
  }
  static void store(double* p, V value) {
    if constexpr (sizeof(R) == sizeof(double))
      *reinterpret_cast<V*>(p) = value;
    else
      *reinterpret_cast<Doubles*>(p) = __builtin_convertvector(value, Doubles);
  }
  static V sqrt(V a) {
#ifdef __AVX512F__
    if constexpr (sizeof(V) == 64 && sizeof(R) == 8) return (V)_mm512_sqrt_pd((__m512d)a);
    if constexpr (sizeof(V) == 64 && sizeof(R) == 4) return (V)_mm512_sqrt_ps((__m512)a);
#endif
#ifdef __AVX__
    if constexpr (sizeof(V) == 32 && sizeof(R) == 8) return (V)_mm256_sqrt_pd((__m256d)a);
    if constexpr (sizeof(V) == 32 && sizeof(R) == 4) return (V)_mm256_sqrt_ps((__m256)a);
#endif
#ifdef __SSE2__
    if constexpr (sizeof(V) == 16 && sizeof(R) == 8) return (V)_mm_sqrt_pd((__m128d)a);
    if constexpr (sizeof(V) == 16 && sizeof(R) == 4) return (V)_mm_sqrt_ps((__m128)a);
#endif
    V root{};
    for (int i = 0; i < N; ++i) root[i] = sizeof(R) == 8 ? R(__builtin_sqrt(a[i])) : R(__builtin_sqrtf(float(a[i])));
    return root;
  }
  /// One bit a lane where the comparison holds.
  template <class Mask>
  static unsigned bits(Mask mask) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    if constexpr (sizeof(V) == 64 && sizeof(R) == 8) return _mm512_movepi64_mask((__m512i)mask);
    if constexpr (sizeof(V) == 64 && sizeof(R) == 4) return _mm512_movepi32_mask((__m512i)mask);
#endif
#ifdef __AVX__
    if constexpr (sizeof(V) == 32 && sizeof(R) == 8) return unsigned(_mm256_movemask_pd((__m256d)mask));
    if constexpr (sizeof(V) == 32 && sizeof(R) == 4) return unsigned(_mm256_movemask_ps((__m256)mask));
#endif
#ifdef __SSE2__
    if constexpr (sizeof(V) == 16 && sizeof(R) == 8) return unsigned(_mm_movemask_pd((__m128d)mask));
    if constexpr (sizeof(V) == 16 && sizeof(R) == 4) return unsigned(_mm_movemask_ps((__m128)mask));
#endif
    unsigned set_bits = 0;
    for (int i = 0; i < N; ++i) set_bits |= mask[i] ? 1u << i : 0u;
    return set_bits;
  }
};

/// One pose: an ordinary double.
template <>
struct Lanes<double, 1> {
  using Real = double;
  static constexpr int kCount = 1;
  using V = double;
  static V set(double value) { return value; }
  static V load(const double* p) { return *p; }
  static void store(double* p, V value) { *p = value; }
  static V sqrt(V a) { return __builtin_sqrt(a); }
  static unsigned bits(bool mask) { return mask; }
};

template <class L>
struct Vector3Of {
  typename L::V x, y, z;
};

}  // namespace
}  // namespace sinew
