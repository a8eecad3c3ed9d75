#include "imaging/calibration/detect_beads.h"

#include <gmock/gmock.h>

#include "tests/imaging/calibration/bead_image.h"

namespace sinew {
namespace {

/// Twelve balls of 5 to 30 px at odd places.
std::vector<test::Shadow> someShadows() {
  std::vector<test::Shadow> shadows;
  for (int i = 0; i < 12; ++i)
    shadows.push_back({{60.0 + 97.37 * (i % 4) + 0.31 * i, 70.0 + 110.73 * (i / 4) + 0.17 * i}, 2.6 + i});
  return shadows;
}

double errorOf(const std::vector<DetectedBead>& found, const test::Shadow& shadow) {
  double best = 1e9;
  for (const auto& bead : found) best = std::min(best, (bead.uv_px - shadow.uv_px).norm());
  return best;
}

TEST(DetectBeads, FindsEveryBallToAFractionOfAPixel) {
  const auto shadows = someShadows();
  const auto found = detectBeads(test::drawShadows(480, 400, shadows, 0, 1));
  EXPECT_EQ(found.size(), shadows.size());
  for (const auto& s : shadows) EXPECT_LT(errorOf(found, s), 0.05) << s.uv_px.transpose() << " r " << s.radius_px;
  for (const auto& bead : found)
    for (const auto& s : shadows)
      if ((bead.uv_px - s.uv_px).norm() < 1) {
        EXPECT_NEAR(bead.diameter_px, 2 * s.radius_px, 0.2 * s.radius_px + 1);
      }
}

TEST(DetectBeads, StatesItsErrorUnderNoise) {
  const auto shadows = someShadows();
  double sum = 0;
  int count = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const auto found = detectBeads(test::drawShadows(480, 400, shadows, 600, seed));  // contrast to noise 20
    for (const auto& bead : found)
      for (const auto& s : shadows)
        if ((bead.uv_px - s.uv_px).norm() < 2) {
          sum += (bead.uv_px - s.uv_px).squaredNorm() / (2 * bead.sigma_px * bead.sigma_px);
          ++count;
        }
  }
  ASSERT_GT(count, 80);
  const double ratio = std::sqrt(sum / count);  // actual over stated
  EXPECT_GT(ratio, 0.6);
  EXPECT_LT(ratio, 1.4);
  if (std::getenv("SINEW_PRINT_RESIDUALS")) std::printf("bead error, actual over stated: %.2f of %d\n", ratio, count);
}

TEST(DetectBeads, EitherPolarity) {
  auto image = test::drawShadows(480, 400, someShadows(), 20, 3);
  auto inverse = *image.pixels;
  for (auto& p : inverse) p = std::uint16_t(65535 - p);
  image.pixels = std::make_shared<const std::vector<std::uint16_t>>(inverse);
  EXPECT_EQ(detectBeads(image).size(), 12u);  // not declared: tried
  image.monochrome1 = true;
  EXPECT_EQ(detectBeads(image).size(), 12u);
}

TEST(DetectBeads, RejectsEdgesLettersAndTheBorder) {
  auto image = test::drawShadows(480, 400, {{{0.5, 200}, 8}}, 20, 4);  // cut by the border
  auto pixels = *image.pixels;
  const auto lift = [&](int u, int v) {
    auto& p = pixels[std::size_t(v) * 480 + std::size_t(u)];
    p = std::uint16_t(p + 12000);
  };
  for (int v = 0; v < 400; ++v)
    for (int u = 200; u < 480; ++u)
      if (u < 220 || (u > 300 && v > 350)) lift(u, v);  // a bar and a corner
  for (int k = 0; k < 40; ++k)
    for (int w = 0; w < 8; ++w) {
      lift(60 + w, 60 + k);  // an L
      if (k >= 8 && k < 28) lift(60 + k, 92 + w);
      lift(340 + k, 100 + k / 2 + w);  // a stroke
    }
  image.pixels = std::make_shared<const std::vector<std::uint16_t>>(pixels);
  for (const auto& bead : detectBeads(image)) ADD_FAILURE() << bead.uv_px.transpose() << " d " << bead.diameter_px;
}

TEST(DetectBeads, NothingInAnEmptyImageAndNoneWhenCancelled) {
  EXPECT_TRUE(detectBeads(test::drawShadows(300, 300, {}, 100, 5)).empty());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(detectBeads(test::drawShadows(480, 400, someShadows(), 0, 1), {}, {{}, stop.get_token()}).empty());
}

}  // namespace
}  // namespace sinew
