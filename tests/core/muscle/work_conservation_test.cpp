// Forces of the units and changes of their lengths are two sides of one thing: work.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "core/muscle/hill.h"
#include "core/muscle/load_musculature.h"
#include "core/muscle/muscle_path.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

class WorkConservation : public testing::Test {
 protected:
  const Skeleton skeleton_ = loadReferenceSkeleton(test::resourceDir());
  const Musculature musculature_ = loadMusculature(test::resourceDir(), skeleton_);
};

/// Load on the coordinates from the forces on the segments: every straight piece of the path pulls its two ends
/// together with the tension; an end that hangs on several segments shares the force by its weights, each share
/// applied where that segment carries the point.
Eigen::VectorXd loadOfTension(const Skeleton& skeleton, const Kinematics& k, const MusculotendonUnit& unit,
                              double tension_N) {
  const auto points = pathPoints(unit, k.X_WB);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(skeleton.coordinateCount());
  const auto apply = [&](const PathPoint& point, const Eigen::Vector3d& force_N) {
    for (const Anchor& a : point.anchors)
      load += pointJacobian(skeleton, k, a.segment, a.p_B).transpose() * (a.weight * force_N);
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector3d pull_N = tension_N * (points[i + 1] - points[i]).normalized();
    apply(unit.path[i], pull_N);
    apply(unit.path[i + 1], -pull_N);
  }
  return load;
}

TEST_F(WorkConservation, ForcesOnTheSegmentsLoadTheCoordinatesAsTheLengthChanges) {
  constexpr double kTolerance_m = 1e-9;
  std::mt19937_64 random{11};
  double worst = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Posture q = postureFromClinical(skeleton_, test::randomClinical(skeleton_, random));
    const std::array charts{kinematics(skeleton_, q), clinicalKinematics(skeleton_, q)};
    for (const Kinematics& k : charts)
      for (const auto& unit : musculature_.units)
        worst =
            std::max(worst, (loadOfTension(skeleton_, k, unit, 1) + lengthGradient(unit, k)).cwiseAbs().maxCoeff());
  }
  std::printf("largest difference of J^T f and -f dl/dq at 1 N: %.1e m\n", worst);
  EXPECT_LT(worst, kTolerance_m);
}

/// A unit with points blended of moving, driven and unlike segments, which the reference has few of.
TEST_F(WorkConservation, HoldsForPointsBlendedOfDrivenSegments) {
  const auto segment = [&](const char* name) { return skeleton_.segmentIndex(name); };
  MusculotendonUnit unit;
  unit.path = {{PathPointRole::Origin,
                {{segment("pelvis"), 0.3, {0.02, 0.1, 0.1}}, {segment("lumbar"), 0.7, {0, 0.1, 0.05}}},
                "",
                ""},
               {PathPointRole::Via,
                {{segment("femur_r"), 0.6, {0.05, -0.3, 0}}, {segment("patella_r"), 0.4, {0, 0.02, 0.01}}},
                "",
                ""},
               {PathPointRole::Via,
                {{segment("hand_r"), 0.5, {0, -0.05, 0}},
                 {segment("radius_r"), 0.2, {0.01, -0.1, 0}},
                 {segment("ulna_r"), 0.3, {0, -0.1, 0.02}}},
                "",
                ""},
               {PathPointRole::Insertion, {{segment("radius_l"), 1, {0.01, -0.1, 0.01}}}, "", ""}};
  std::mt19937_64 random{5};
  for (int trial = 0; trial < 50; ++trial) {
    const Kinematics k =
        kinematics(skeleton_, postureFromClinical(skeleton_, test::randomClinical(skeleton_, random)));
    EXPECT_LT((loadOfTension(skeleton_, k, unit, 1) + lengthGradient(unit, k)).cwiseAbs().maxCoeff(), 1e-12);
  }
}

/// Force is a function of length alone, so the work around any closed loop of postures vanishes: passive, and at a
/// held activation.
TEST_F(WorkConservation, ClosedLoopsOfPosturesCostNothing) {
  // The trapezoid rule on a smooth periodic function is exact; corners in the slopes of the curves and of the
  // patella's glide leave an error of second order in the step.
  constexpr int kSteps = 1500;
  constexpr double kShareOfWork = 1e-6;
  std::mt19937_64 random{23};
  for (const double activation : {0.0, 0.0, 0.3}) {
    const Eigen::VectorXd from = 0.6 * test::randomClinical(skeleton_, random);
    const Posture centre = postureFromClinical(skeleton_, from);
    const auto direction = [&] {
      return Eigen::VectorXd{Eigen::VectorXd::NullaryExpr(centre.size(), [&] {
        return std::uniform_real_distribution{-0.3, 0.3}(random);
      })};
    };
    const Eigen::VectorXd a = direction(), b = direction(), c = direction();
    double work_J = 0, moved_J = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = 2 * std::numbers::pi * i / kSteps, dt = 2 * std::numbers::pi / kSteps;
      const Posture q = centre + a * std::cos(t) + b * std::sin(t) + c * std::cos(2 * t);
      const Eigen::VectorXd dq = (-a * std::sin(t) + b * std::cos(t) - 2 * c * std::sin(2 * t)) * dt;
      const Kinematics k = kinematics(skeleton_, q);
      for (const auto& unit : musculature_.units) {
        const double tension_N = equilibrium(unit, pathLength(unit, k.X_WB), activation).force_N;
        if (tension_N == 0) continue;
        const double work = -tension_N * lengthGradient(unit, k).dot(dq);
        work_J += work;
        moved_J += std::abs(work);
      }
    }
    std::printf("work around the loop at activation %.1f: %.1e of %.0f J moved\n", activation, work_J / moved_J,
                moved_J);
    EXPECT_GT(moved_J, 100);
    EXPECT_LT(std::abs(work_J), kShareOfWork * moved_J);
  }
}

}  // namespace
}  // namespace sinew
