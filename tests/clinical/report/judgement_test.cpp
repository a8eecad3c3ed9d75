#include "clinical/report/judgement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sinew {
namespace {

TEST(Judgement, NeedsTwoStandardDeviationsAndTheIntervalBeyondThem) {
  EXPECT_EQ(judge(8, 7, 9, 0, 3), Judgement::Above);
  EXPECT_EQ(judge(-8, -9, -7, 0, 3), Judgement::Below);
  EXPECT_EQ(judge(6.5, 5.5, 7.5, 0, 3), Judgement::Within);  // may well be 6
  EXPECT_EQ(judge(5, 4.9, 5.1, 0, 3), Judgement::Within);
  EXPECT_EQ(judge(8, -20, 40, 0, 3), Judgement::Within);  // nothing is known of it
}

TEST(Judgement, OfAMeasurementFollowsItsStandardDeviation) {
  EXPECT_EQ(judgeMeasured(60, 4, 26, 12), Judgement::Above);   // 60 - 7.8 > 50
  EXPECT_EQ(judgeMeasured(55, 4, 26, 12), Judgement::Within);  // 55 - 7.8 < 50
  EXPECT_EQ(judgeMeasured(-10, 4, 26, 12), Judgement::Below);
}

TEST(Judgement, WithoutANormOrAValueThereIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto j : {judge(nan, nan, nan, 0, 3), judge(8, 7, 9, nan, 3), judge(8, 7, 9, 0, nan),
                       judge(8, nan, nan, 0, 3), judge(8, 7, 9, 0, 0)})
    EXPECT_EQ(j, Judgement::Within);
  EXPECT_STREQ(markOf(Judgement::Within), "");
}

}  // namespace
}  // namespace sinew
