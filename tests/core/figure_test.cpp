#include "core/figure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew {
namespace {

TEST(RoundStep, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(roundStep(100, 10), 10);
  EXPECT_DOUBLE_EQ(roundStep(100, 9), 20);
  EXPECT_DOUBLE_EQ(roundStep(0.7, 4), 0.2);
  EXPECT_DOUBLE_EQ(roundStep(0, 4), 1);
  for (double span = 0.03; span < 5000; span *= 1.37) {
    EXPECT_LE(span / roundStep(span, 10), 10 + 1e-9) << span;
    EXPECT_GT(span / roundStep(span, 10), 4 - 1e-9) << span;  // a step is at most 2.5 times as long as it need be
  }
}

TEST(FigureRange, HoldsEveryLineWithRoom) {
  FigurePanel panel{"force [N]", {{"a", {{0, 2}, {10, 6}, {20, NAN}}}}, {{"limit", 8, LineRole::Alarm, true}}};
  const Figure figure{"", "angle [deg]", {panel}};
  EXPECT_EQ(rangeOfX(figure).low, 0);
  EXPECT_EQ(rangeOfX(figure).high, 20);  // where a line is interrupted counts too
  const FigureRange y = rangeOfY(panel);
  EXPECT_LT(y.low, 2);
  EXPECT_GT(y.low, 1);
  EXPECT_GT(y.high, 8);  // with the mark's name above it
  EXPECT_LT(y.high, 10);
  panel.from_zero = true;
  EXPECT_EQ(rangeOfY(panel).low, 0);
  panel.highest = 5;
  EXPECT_EQ(rangeOfY(panel).high, 5);
}

TEST(FigureRange, IsNeverEmpty) {
  EXPECT_LT(rangeOfX({}).low, rangeOfX({}).high);
  for (const auto& points : {std::vector<std::pair<double, double>>{}, {{1, 3}}, {{1, 0}, {1, 0}}, {{1, NAN}}}) {
    const FigurePanel panel{"", {{"", points}}};
    EXPECT_LT(rangeOfY(panel).low, rangeOfY(panel).high);
    EXPECT_LT(rangeOfX({"", "", {panel}}).low, rangeOfX({"", "", {panel}}).high);
  }
}

}  // namespace
}  // namespace sinew
