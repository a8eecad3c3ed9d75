#include "imaging/xray/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/file.h"

namespace sinew {
namespace {

constexpr int kWidth = 200, kHeight = 150;

/// Only Beer-Lambert: nothing else between exponent and grey value.
Exposure plain() {
  Exposure e;
  e.scatter_ratio = e.blur_mm = e.shutter_mm = e.equalization = 0;
  e.quantum_noise = false;
  return e;
}
PixelField uniform(double attenuation) {
  return PixelField(std::size_t(kWidth * kHeight), float(attenuation));
}

struct Statistics {
  double mean = 0, sd = 0;
};
Statistics statistics(const std::vector<std::uint16_t>& pixels) {
  double sum = 0, sum2 = 0;
  for (const double p : pixels) sum += p, sum2 += p * p;
  const double mean = sum / double(pixels.size());
  return {mean, std::sqrt(sum2 / double(pixels.size()) - mean * mean)};
}

TEST(Expose, PutsTheBeerLambertExponentOnALogarithmicScale) {
  for (const double attenuation : {0.0, 0.7, 2.5, 6.0}) {
    const auto image = expose(uniform(attenuation), kWidth, plain());
    EXPECT_NEAR(image.pixels[1234], greyValueOf(attenuation), 1) << attenuation;  // rounding of float and grey value
  }
  EXPECT_NEAR(greyValueOf(3) - greyValueOf(2), greyValueOf(1) - greyValueOf(0), 1e-9);
}

TEST(Expose, NoiseIsThatOfThePhotonsThatArrive) {
  // Poisson: the exponent's standard deviation is 1 / sqrt(N), N = N0 exp(-a).
  Exposure noisy = plain();
  noisy.quantum_noise = true;
  noisy.photons_per_px = 1e5;
  for (const double attenuation : {0.5, 3.0}) {
    const auto s = statistics(expose(uniform(attenuation), kWidth, noisy).pixels);
    const double expected = (greyValueOf(1) - greyValueOf(0)) / std::sqrt(1e5 * std::exp(-attenuation));
    EXPECT_NEAR(s.sd, expected, 0.03 * expected) << attenuation;  // 30,000 pixels: 0.4 % sampling error, rounding
    EXPECT_NEAR(s.mean, greyValueOf(attenuation), 0.5);
  }
}

TEST(Expose, BlurKeepsTheMeanAndHasTheStatedWidth) {
  PixelField point = uniform(0);
  point[75 * kWidth + 100] = 0.01F;  // weak: the exponential is linear
  Exposure soft = plain();
  soft.blur_mm = 2 * soft.pixel_mm;
  const PixelField spread = blurred(point, kWidth, 2, 2);
  double mass = 0, moment = 0;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      mass += spread[v * kWidth + u];
      moment += spread[v * kWidth + u] * (u - 100) * (u - 100);
    }
  EXPECT_NEAR(mass, 0.01, 1e-6);
  EXPECT_NEAR(std::sqrt(moment / mass), 2, 0.02);  // the kernel ends at 3.5 standard deviations
  EXPECT_LT(expose(point, kWidth, soft).pixels[75 * kWidth + 100],
            expose(point, kWidth, plain()).pixels[75 * kWidth + 100]);
}

TEST(Expose, BroadBlurIsAGaussianToo) {
  PixelField step = uniform(0);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 100; u < kWidth; ++u) step[v * kWidth + u] = 1;
  const PixelField soft = broadlyBlurred(step, kWidth, 20);
  const auto expected = [](double x) { return 0.5 * std::erfc(-x / (20 * std::sqrt(2))); };
  for (const int u : {60, 80, 100, 120, 140})
    EXPECT_NEAR(soft[75 * kWidth + u], expected(u + 0.5 - 100), 0.02) << u;  // coarse grid adds 4 % to the width
}

TEST(Expose, EqualizationTakesAwayTheStatedShareOfASlowChange) {
  PixelField two(std::size_t(2000) * 10, 2.0F);
  for (int v = 0; v < 10; ++v)
    for (int u = 1000; u < 2000; ++u) two[v * 2000 + u] = 5.0F;
  Exposure e = plain();
  e.equalization = 0.4;
  const auto image = expose(two, 2000, e);
  const double span = double(image.pixels[5 * 2000 + 1900]) - double(image.pixels[5 * 2000 + 100]);
  EXPECT_NEAR(span / (greyValueOf(5) - greyValueOf(2)), 0.6, 0.01);
}

TEST(Expose, MarkerIsReadableAndTheMarginBlack) {
  Exposure e = plain();
  e.shutter_mm = 2;
  e.markers = {{'L', 20, 20, 18}};
  const auto image = expose(uniform(0.5), kWidth, e);
  const auto at = [&](double u_mm, double v_mm) {
    return image.pixels[int(v_mm / e.pixel_mm) * kWidth + int(u_mm / e.pixel_mm)];
  };
  EXPECT_EQ(image.pixels[3 * kWidth + 50], 0);
  const double lead = greyValueOf(0.5 + e.lead), tissue = greyValueOf(0.5);
  EXPECT_NEAR(at(20 - 0.25 * 18, 20), lead, 2);              // the stem, left of the middle
  EXPECT_NEAR(at(20, 20 + 0.45 * 18), lead, 2);              // the foot
  EXPECT_NEAR(at(20 + 0.2 * 18, 20 - 0.2 * 18), tissue, 2);  // an L is empty at the top right
  e.markers = {{'R', 20, 20, 18}};
  const auto r = expose(uniform(0.5), kWidth, e);
  EXPECT_NEAR(r.pixels[int((20 - 0.2 * 18) / e.pixel_mm) * kWidth + int((20 + 0.25 * 18) / e.pixel_mm)], lead,
              2);  // bowl
}

TEST(Expose, SameSeedSameImageOtherSeedOtherNoise) {
  Exposure e;
  const auto hash = [&] {
    const auto image = expose(uniform(2), kWidth, e);
    return sha256({reinterpret_cast<const char*>(image.pixels.data()), 2 * image.pixels.size()});
  };
  const auto first = hash();
  EXPECT_EQ(hash(), first);
  e.seed = 2;
  EXPECT_NE(hash(), first);
}

TEST(Grain, HasMeanZeroUnitVarianceAndTheStatedGrainSize) {
  const auto field = grain(400, 400, 3, 3, 5);
  double sum = 0, sum2 = 0, lag = 0;
  for (int v = 0; v < 400; ++v)
    for (int u = 0; u + 3 < 400; ++u) {
      const double x = field[v * 400 + u];
      sum += x, sum2 += x * x, lag += x * field[v * 400 + u + 3];
    }
  const double n = 400 * 397;
  EXPECT_NEAR(sum / n, 0, 0.1);  // about 400^2 / (4 pi 9) = 1400 independent grains: 0.03
  EXPECT_NEAR(sum2 / n, 1, 0.1);
  EXPECT_NEAR(lag / sum2, std::exp(-0.25),
              0.05);  // autocorrelation of white noise after a Gaussian: exp(-d^2 / 4 s^2)
}

}  // namespace
}  // namespace sinew
