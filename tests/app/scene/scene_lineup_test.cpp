#include <gtest/gtest.h>

#include "app/scene/lineup.h"
#include "tests/support/plain_model.h"

namespace sinew {
namespace {

bool isWhite(const std::uint8_t* p) {
  return p[0] > 250 && p[1] > 250 && p[2] > 250;
}

/// Rows of the picture in which a body is drawn, between two columns.
std::pair<int, int> drawnRows(const RgbImage& image, int from_px, int to_px) {
  int top = image.height_px, bottom = -1;
  for (int v = 0; v < image.height_px; ++v)
    for (int u = from_px; u < to_px; ++u)
      if (!isWhite(image.at(u, v))) top = std::min(top, v), bottom = std::max(bottom, v);
  return {top, bottom};
}

TEST(Lineup, BodiesStandOnOneGroundToOneScale) {
  const auto small = std::make_shared<const Model>(test::plainModel());
  ShapeParameters shape;
  for (auto& side : shape.sides) side.femur.elongation = side.tibia.elongation = 1.5;
  const auto tall = std::make_shared<const Model>(deformedModel(*small, shape));
  EXPECT_LT(lowestPoint_m(*tall, zeroPosture(tall->skeleton)), -0.3);  // its feet are below the reference's
  EXPECT_NEAR(lowestPoint_m(*tall, standingOnGround(*tall)), 0, 1e-12);
  const auto stand = [](const auto& model) { return LineupBody{model, standingOnGround(*model)}; };
  LineupPicture picture;
  picture.height_px = 200;
  picture.quality = {1, false};
  const Lineup lineup = renderLineup({stand(small), stand(tall)}, picture);
  ASSERT_EQ(lineup.centre_px.size(), 2U);
  const int middle_px = (lineup.centre_px[0] + lineup.centre_px[1]) / 2;
  const auto left = drawnRows(lineup.image, 0, middle_px),
             right = drawnRows(lineup.image, middle_px, lineup.image.width_px);
  EXPECT_NEAR(left.second, lineup.ground_px, 2);  // pixels
  EXPECT_NEAR(right.second, lineup.ground_px, 2);
  // Femur and tibia, 0.86 m of joint-to-joint length about, grow by half.
  EXPECT_GT((left.first - right.first) * lineup.pixel_m, 0.35);
  EXPECT_LT((left.first - right.first) * lineup.pixel_m, 0.50);
}

}  // namespace
}  // namespace sinew
