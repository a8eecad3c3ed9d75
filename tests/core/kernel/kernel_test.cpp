#include <gtest/gtest.h>

#include "core/error.h"
#include "core/kernel/batch.h"
#include "core/kernel/sweep.h"
#include "core/muscle/hill.h"
#include "core/muscle/load_musculature.h"
#include "core/muscle/muscle_path.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

constexpr double kExact = 1e-12;  // relative: a few dozen roundings in double

const Skeleton& skeleton() {
  static const Skeleton loaded = loadReferenceSkeleton(test::resourceDir());
  return loaded;
}
const Musculature& musculature() {
  static const Musculature loaded = loadMusculature(test::resourceDir(), skeleton());
  return loaded;
}

/// 37 postures: two full blocks of 16 and a rest. The first is zero, the second has turns far beyond half a turn, the
/// third tiny ones.
std::vector<Posture> somePostures() {
  std::mt19937_64 random{23};
  std::vector<Posture> postures;
  for (int i = 0; i < 37; ++i)
    postures.push_back(postureFromClinical(skeleton(), test::randomClinical(skeleton(), random)));
  postures[0].setZero();
  postures[1] *= 9;
  postures[2] *= 1e-9;
  return postures;
}

class KernelAtEveryIsa : public testing::TestWithParam<Isa> {
 protected:
  CompiledModel model_{skeleton(), musculature(), GetParam()};
  std::vector<Posture> postures_ = somePostures();
  PoseTable table_{postures_};
};
INSTANTIATE_TEST_SUITE_P(Kernel, KernelAtEveryIsa, testing::ValuesIn(supportedIsas()),
                         [](const auto& tested) { return std::string{isaName(tested.param)}; });

TEST_P(KernelAtEveryIsa, PosesOfAllSegmentsAreThoseOfTheKinematics) {
  PoseTable X_WB;
  batchPoses(model_, table_, X_WB);
  for (std::size_t i = 0; i < postures_.size(); ++i) {
    const auto expected = segmentPoses(skeleton(), postures_[i]);
    for (std::size_t s = 0; s < expected.size(); ++s)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c)
          EXPECT_NEAR(X_WB(i, 12 * s + 4 * r + c), expected[s](r, c), kExact * (1 + std::abs(expected[s](r, 3))))
              << skeleton().segments[s].name << " posture " << i;
  }
}

TEST_P(KernelAtEveryIsa, LengthsAndGradientsAreThoseOfTheReadableCode) {
  constexpr double kSingle_m = 1e-5;  // what Precision::Single promises
  PoseTable lengths, lengths_too, in_single, gradients;
  batchLengths(model_, table_, lengths);
  batchLengths(model_, table_, in_single, Precision::Single);
  batchGradients(model_, table_, lengths_too, gradients);
  for (std::size_t i = 0; i < postures_.size(); ++i) {
    const Kinematics k = kinematics(skeleton(), postures_[i]);
    PostureKernel alone{model_};
    alone.evaluate(postures_[i]);
    for (std::size_t u = 0; u < musculature().units.size(); ++u) {
      const MusculotendonUnit& unit = musculature().units[u];
      const double length = pathLength(unit, k.X_WB);
      EXPECT_NEAR(lengths(i, u), length, kExact * length) << unit.name;
      EXPECT_NEAR(lengths_too(i, u), length, kExact * length) << unit.name;
      EXPECT_NEAR(in_single(i, u), length, kSingle_m) << unit.name;
      EXPECT_NEAR(alone.lengths_m()[u], length, kExact * length) << unit.name;
      Eigen::VectorXd gradient = Eigen::VectorXd::Zero(postures_[i].size()), single = gradient;
      for (int e = model_.gradientStart()[u]; e < model_.gradientStart()[u + 1]; ++e) {
        gradient[model_.gradientCoordinate()[e]] = gradients(i, e);
        single[model_.gradientCoordinate()[e]] = alone.gradients()[e];
      }
      const Eigen::VectorXd expected = lengthGradient(unit, k);
      EXPECT_LT((gradient - expected).cwiseAbs().maxCoeff(), kExact) << unit.name << " posture " << i;
      EXPECT_LT((single - expected).cwiseAbs().maxCoeff(), kExact) << unit.name << " posture " << i;
    }
  }
}

TEST_P(KernelAtEveryIsa, ASweepKeepsTheLongestPathsAndWhoAllowsWhat) {
  std::vector<double> longest(musculature().units.size(), 0.0);
  std::vector<bool> valid(postures_.size(), true);
  for (std::size_t i = 0; i < postures_.size(); ++i) {
    const auto X_WB = segmentPoses(skeleton(), postures_[i]);
    for (std::size_t u = 0; u < longest.size(); ++u) {
      const double length = pathLength(musculature().units[u], X_WB);
      longest[u] = std::max(longest[u], length);
      if (length > longestLength_m(musculature().units[u])) valid[i] = false;
    }
  }
  const auto read = [&](std::size_t first, PoseTable& table) {
    for (std::size_t i = 0; i < table.poseCount(); ++i) table.set(i, postures_[first + i]);
  };
  for (const auto precision : {Precision::Double, Precision::Single}) {
    const PostureSweep sweep = sweepPostures(model_, postures_.size(), read, precision);
    for (std::size_t u = 0; u < longest.size(); ++u) {
      const double tolerance = precision == Precision::Double ? kExact : 1e-5;
      EXPECT_NEAR(sweep.longest_m[u], longest[u], tolerance) << musculature().units[u].name;
      const auto at = segmentPoses(skeleton(), postures_[sweep.longest_posture[u]]);
      EXPECT_NEAR(pathLength(musculature().units[u], at), sweep.longest_m[u], kExact);
    }
    for (std::size_t i = 0; i < postures_.size(); ++i) EXPECT_EQ(sweep.valid[i] == 1, valid[i]) << i;
  }
}

TEST(Kernel, GradientsHaveTheCoordinatesThatAUnitSpans) {
  const CompiledModel model{skeleton(), musculature()};
  const auto coordinatesOf = [&](const char* unit) {
    std::vector<std::string> names;
    const int u = musculature().unitIndex(unit);
    for (int e = model.gradientStart()[u]; e < model.gradientStart()[u + 1]; ++e)
      names.push_back(skeleton().coordinates[model.gradientCoordinate()[e]].name);
    return names;
  };
  EXPECT_EQ(coordinatesOf("brachialis_r"), std::vector<std::string>{"elbow_flexion_r"});
  EXPECT_EQ(coordinatesOf("rectus_femoris_l").size(), 4u);      // hip, and the knee through the patella
  EXPECT_EQ(coordinatesOf("pronator_quadratus_r").size(), 3u);  // the wrist's, through the radius
}

TEST(Kernel, UnitsOfManyBlendedPointsAreNoSpecialCase) {
  // Nine points, each shared by four segments with unequal weights, from the thorax to the hand and the patella.
  Musculature two;
  std::mt19937_64 random{5};
  const auto number = [&] { return std::generate_canonical<double, 53>(random) - 0.5; };
  for (int i = 0; i < 2; ++i) {
    MusculotendonUnit unit{.name = "odd", .optimal_fiber_length_m = 1};
    for (int p = 0; p < 9; ++p) {
      PathPoint point;
      for (const char* s : {"thorax", "radius_r", "hand_r", i ? "patella_l" : "ulna_r"})
        point.anchors.push_back({skeleton().segmentIndex(s), 0.25, {number(), number(), number()}});
      unit.path.push_back(point);
    }
    two.units.push_back(unit);
  }
  const auto postures = somePostures();
  for (const Isa isa : supportedIsas()) {
    const CompiledModel model{skeleton(), two, isa};
    PoseTable lengths, gradients;
    batchGradients(model, PoseTable{postures}, lengths, gradients);
    for (std::size_t i = 0; i < postures.size(); ++i)
      for (std::size_t u = 0; u < 2; ++u) {
        const Kinematics k = kinematics(skeleton(), postures[i]);
        EXPECT_NEAR(lengths(i, u), pathLength(two.units[u], k.X_WB), kExact * lengths(i, u));
        Eigen::VectorXd gradient = Eigen::VectorXd::Zero(postures[i].size());
        for (int e = model.gradientStart()[u]; e < model.gradientStart()[u + 1]; ++e)
          gradient[model.gradientCoordinate()[e]] = gradients(i, e);
        EXPECT_LT((gradient - lengthGradient(two.units[u], k)).cwiseAbs().maxCoeff(), 10 * kExact);
      }
  }
}

TEST(Kernel, AUnitOnOneBoneHasAConstantLengthAndTurnsNothing) {
  const int femur = skeleton().segmentIndex("femur_r");
  MusculotendonUnit unit{.name = "strip", .optimal_fiber_length_m = 1};
  for (const double y : {0.0, -0.1, -0.3}) unit.path.push_back({PathPointRole::Via, {{femur, 1, {0, y, 0}}}, "", ""});
  const CompiledModel model{skeleton(), Musculature{{unit}}};
  PoseTable lengths, gradients;
  batchGradients(model, PoseTable{somePostures()}, lengths, gradients);
  for (std::size_t i = 0; i < lengths.poseCount(); ++i) EXPECT_NEAR(lengths(i, 0), 0.3, 1e-15);
  EXPECT_EQ(gradients.entryCount(), 0u);
}

TEST(Kernel, AnIsaIsChosenByNameAndAWrongOneRefused) {
  ASSERT_EQ(setenv("SINEW_ISA", "baseline", 1), 0);
  EXPECT_EQ(chosenIsa(), Isa::Baseline);
  ASSERT_EQ(setenv("SINEW_ISA", "v9", 1), 0);
  EXPECT_THROW(chosenIsa(), InputError);
  ASSERT_EQ(unsetenv("SINEW_ISA"), 0);
  EXPECT_EQ(chosenIsa(), supportedIsas().back());
}

}  // namespace
}  // namespace sinew
