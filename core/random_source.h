#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace sinew {

/// Random numbers that are the same with every standard library: the engine is fixed by the standard, the
/// distributions (which are not) are ours.
class RandomSource {
 public:
  /// Streams of one seed are independent of each other, so that drawing more of one thing leaves the others alone.
  explicit RandomSource(std::uint64_t seed, std::uint64_t stream = 0)
      : engine_{scrambled(seed + 0x9E3779B97F4A7C15ULL * (stream + 1))} {}

  /// In [0, 1), 53 bits.
  double uniform() { return double(engine_() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Standard normal (Box & Muller 1958).
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double r = std::sqrt(-2 * std::log(1 - uniform())), angle = 2 * std::numbers::pi * uniform();
    spare_ = r * std::sin(angle);
    has_spare_ = true;
    return r * std::cos(angle);
  }

  /// Normal, redrawn until within `limit` standard deviations.
  double truncatedNormal(double limit = 2) {
    double z = normal();
    while (std::abs(z) > limit) z = normal();
    return z;
  }

 private:
  /// Finaliser of SplitMix64 (Steele, Lea & Flood 2014): neighbouring seeds become unlike each other.
  static std::uint64_t scrambled(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31);
  }

  std::mt19937_64 engine_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace sinew
