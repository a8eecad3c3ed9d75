// Lengths of all units over the joint motions: smooth, without jumps.
#include <gtest/gtest.h>

#include <set>

#include "core/csv_table.h"
#include "core/muscle/load_musculature.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/joint_motion.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

class LengthOverMotions : public testing::Test {
 protected:
  const Skeleton skeleton_ = loadReferenceSkeleton(test::resourceDir());
  const Musculature musculature_ = loadMusculature(test::resourceDir(), skeleton_);
  const std::vector<JointMotion> motions_ = loadJointMotions(test::resourceDir(), skeleton_);
};

TEST_F(LengthOverMotions, NeverJumps) {
  // A jump is a slope, over one step, that differs from that of the step before by more than 1 mm per degree. A
  // smooth arm of 10 cm has a slope of 1.7 mm per degree, but it changes by less than a hundredth of that in a step.
  constexpr double kStep_deg = 0.25, kJump_m_per_deg = 1e-3;
  double worst = 0;
  std::string worst_at;
  for (const JointMotion& motion : motions_) {
    const double span_deg = std::abs(motion.end_deg - motion.start_deg);
    const int steps = static_cast<int>(std::lround(span_deg / kStep_deg));
    std::vector<double> before(musculature_.units.size()), slope_before(musculature_.units.size());
    for (int i = 0; i <= steps; ++i) {
      const auto X_WB = segmentPoses(skeleton_, motionPosture(skeleton_, motion, static_cast<double>(i) / steps));
      for (std::size_t u = 0; u < before.size(); ++u) {
        const double length_m = pathLength(musculature_.units[u], X_WB);
        const double slope = (length_m - before[u]) / (span_deg / steps);
        const double jump = std::abs(slope - slope_before[u]);
        if (i >= 2 && jump > worst) {
          worst = jump;
          worst_at = musculature_.units[u].name + " over " + motion.name;
        }
        if (i >= 2) {
          EXPECT_LT(jump, kJump_m_per_deg) << musculature_.units[u].name << " over " << motion.name;
        }
        before[u] = length_m;
        slope_before[u] = slope;
      }
    }
  }
  std::printf("largest change of slope in a step: %.3f mm per degree, %s\n", 1e3 * worst, worst_at.c_str());
}

/// The motions that the table of functions is judged over: either way of every coordinate in it, start to end as
/// theta goes from 0 to 1, over at least the range in which its sign must hold.
TEST_F(LengthOverMotions, ExistForEveryFunction) {
  const CsvTable table{test::testDataDir() / "muscle_functions.csv",
                       "sinew.test.muscle_functions",
                       1,
                       {"coordinate", "min_deg", "max_deg"}};
  std::set<std::string> of_table;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const std::string& coordinate = table.text(row, "coordinate");
    of_table.insert(coordinate);
    for (const bool rising : {true, false}) {
      bool found = false;
      for (const JointMotion& motion : motions_)
        found = found || (motion.coordinate == coordinate && (motion.end_deg > motion.start_deg) == rising &&
                          std::min(motion.start_deg, motion.end_deg) <= table.number(row, "min_deg") &&
                          std::max(motion.start_deg, motion.end_deg) >= table.number(row, "max_deg"));
      EXPECT_TRUE(found) << coordinate << (rising ? " rising" : " falling") << ": " << table.where(row);
    }
  }
  EXPECT_EQ(of_table.size(), 25u);
  std::size_t unsided = 0;
  for (const JointMotion& motion : motions_) {
    EXPECT_DOUBLE_EQ(motion.angle_deg(0), motion.start_deg);
    EXPECT_DOUBLE_EQ(motion.angle_deg(1), motion.end_deg);
    unsided += !motion.name.ends_with("_l");
  }
  EXPECT_EQ(unsided, 50u);  // at least 40 were asked for
}

}  // namespace
}  // namespace sinew
