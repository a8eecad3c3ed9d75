#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/retarget/prepared/length_curve.h"

namespace sinew {
namespace {

template <class Curve>
std::array<double, 11> sampled(const Curve& curve) {
  std::array<double, 11> samples{};
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = curve(0.1 * static_cast<double>(i));
  return samples;
}

TEST(LengthCurve, AParabolasVertexIsFoundExactlyBetweenSamples) {
  const auto samples = sampled([](double theta) { return 2 - (theta - 0.437) * (theta - 0.437); });
  const CurveFeatures f = curveFeatures(samples);
  EXPECT_NEAR(f.longest.theta, 0.437, 1e-12);
  EXPECT_NEAR(f.longest.value, 2, 1e-12);
  EXPECT_NEAR(f.shortest.theta, 1, 1e-12);
  EXPECT_NEAR(f.range(), 0.563 * 0.563, 1e-12);
}

TEST(LengthCurve, AStraightCurveHasItsExtremaAtTheEnds) {
  const CurveFeatures f = curveFeatures(sampled([](double theta) { return 1 + 0.3 * theta; }));
  EXPECT_DOUBLE_EQ(f.longest.theta, 1);
  EXPECT_DOUBLE_EQ(f.shortest.theta, 0);
  EXPECT_NEAR(f.range(), 0.3, 1e-12);
}

TEST(LengthCurve, ASineIsFoundWithinAHundredth) {
  const auto samples = sampled([](double theta) { return std::sin(2 * std::numbers::pi * theta); });
  const CurveFeatures f = curveFeatures(samples);
  EXPECT_NEAR(f.longest.theta, 0.25, 0.01);  // the parabola's own error at 11 samples
  EXPECT_NEAR(f.shortest.theta, 0.75, 0.01);
}

TEST(LengthCurve, SlopesAreThoseOfTheFeatures) {
  auto samples = sampled([](double theta) { return std::sin(5 * theta) + 0.2 * theta; });
  const CurveFeatures f = curveFeatures(samples);
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(f.longest.first_sample + k), slot = static_cast<std::size_t>(k);
    auto more = samples, less = samples;
    more[at] += kStep;
    less[at] -= kStep;
    const CurveFeatures up = curveFeatures(more), down = curveFeatures(less);
    EXPECT_NEAR(f.longest.theta_slope[slot], (up.longest.theta - down.longest.theta) / (2 * kStep), 1e-6);
    EXPECT_NEAR(f.longest.value_slope[slot], (up.longest.value - down.longest.value) / (2 * kStep), 1e-6);
  }
}

}  // namespace
}  // namespace sinew
