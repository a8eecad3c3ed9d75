#include <gmock/gmock.h>

#include <cstdio>
#include <numbers>

#include "core/foreign/foreign_from_model.h"
#include "core/foreign/length_deviation.h"
#include "core/io/osim/osim_reader.h"
#include "core/io/osim/osim_writer.h"
#include "core/muscle/muscle_path.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

constexpr double kTenthOfAMillimetre_m = 1e-4;

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}
const ForeignModel& exported() {
  static const ForeignModel model = foreignFromModel(reference());
  return model;
}
const ForeignModel& readBack() {
  static const ForeignModel model = osimFromText(osimText(exported()), "export.osim");
  return model;
}

bool onRadius(const MusculotendonUnit& unit) {
  return std::ranges::any_of(unit.path, [](const PathPoint& p) {
    return std::ranges::any_of(p.anchors, [](const Anchor& a) {
      return std::ranges::any_of(reference().skeleton.radii,
                                 [&](const RadiusDriver& d) { return d.segment == a.segment; });
    });
  });
}
bool isBlended(const MusculotendonUnit& unit) {
  return std::ranges::any_of(unit.path, [](const PathPoint& p) { return p.anchors.size() > 1; });
}

TEST(OsimExport, IsReadBackWithoutWarningsAndWithTheSameNumbers) {
  const Skeleton& s = reference().skeleton;
  EXPECT_TRUE(readBack().warnings.empty()) << readBack().warnings.front().message;
  ASSERT_EQ(readBack().bodies.size(), s.segments.size());
  double mass_kg = 0, ours_kg = 0;
  for (std::size_t i = 0; i < s.segments.size(); ++i) {
    EXPECT_EQ(readBack().bodies[i].name, s.segments[i].name);
    EXPECT_EQ(readBack().bodies[i].mass_kg, exported().bodies[i].mass_kg);
    EXPECT_EQ(readBack().bodies[i].inertia_B_kgm2, exported().bodies[i].inertia_B_kgm2);
    EXPECT_EQ(readBack().bodies[i].p_BCom, exported().bodies[i].p_BCom);
    mass_kg += readBack().bodies[i].mass_kg;
    ours_kg += s.segments[i].mass_kg;
  }
  EXPECT_NEAR(mass_kg, ours_kg, 1e-12);
  ASSERT_EQ(readBack().coordinates.size(), 52u);  // 50 and the two patellae
  for (const Coordinate& ours : s.coordinates) {
    const ForeignCoordinate& c =
        readBack().coordinates[static_cast<std::size_t>(readBack().coordinateIndex(ours.name))];
    EXPECT_EQ(c.min, ours.stop_min_rad) << ours.name;
    EXPECT_EQ(c.max, ours.stop_max_rad) << ours.name;
    EXPECT_EQ(c.translational, ours.translational) << ours.name;
    EXPECT_TRUE(c.clamped);
  }
  ASSERT_EQ(readBack().musculature.units.size(), 282u);
  for (const MusculotendonUnit& ours : reference().musculature.units) {
    const MusculotendonUnit& unit = readBack().musculature.unit(ours.name);
    EXPECT_EQ(unit.max_isometric_force_N, ours.max_isometric_force_N);
    EXPECT_EQ(unit.optimal_fiber_length_m, ours.optimal_fiber_length_m);
    EXPECT_EQ(unit.tendon_slack_length_m, ours.tendon_slack_length_m);
    EXPECT_EQ(unit.pennation_angle_at_optimal_rad, ours.pennation_angle_at_optimal_rad);
  }
}

/// Everything but the radius: the same bodies at the same places in 100 postures.
TEST(OsimExport, BodiesAndPlainUnitsAreWhereOursAre) {
  const Skeleton& s = reference().skeleton;
  std::mt19937_64 random{43};
  int plain = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::VectorXd clinical = test::randomClinical(s, random);
    const auto X_WB = segmentPoses(s, postureFromClinical(s, clinical));
    ForeignPosture q = defaultPosture(readBack());
    for (int i = 0; i < clinical.size(); ++i)
      q[readBack().coordinateIndex(s.coordinates[static_cast<std::size_t>(i)].name)] = clinical[i];
    const auto theirs = bodyPoses(readBack(), q);
    for (std::size_t i = 0; i < X_WB.size(); ++i) {
      const bool radius = std::ranges::any_of(s.radii, [&](const RadiusDriver& d) { return d.segment == int(i); });
      const double tolerance =
          radius || i >= std::size_t(s.movingSegmentCount()) ? 1e-6 : 1e-9;  // spline of the patella
      EXPECT_LT((theirs[i].translation() - X_WB[i].translation()).norm(), tolerance) << s.segments[i].name;
      if (!radius) {
        EXPECT_LT((theirs[i].linear() - X_WB[i].linear()).norm(), 1e-4) << s.segments[i].name;
      }
    }
    const Eigen::VectorXd length_m = foreignLengths(readBack(), q);
    plain = 0;
    for (std::size_t u = 0; u < reference().musculature.units.size(); ++u) {
      const MusculotendonUnit& unit = reference().musculature.units[u];
      if (isBlended(unit) || onRadius(unit)) continue;
      ++plain;
      EXPECT_NEAR(length_m[readBack().musculature.unitIndex(unit.name)], pathLength(unit, X_WB),
                  kTenthOfAMillimetre_m)
          << unit.name;
    }
  }
  std::printf("%d units without blended points and not on the radius\n", plain);
  EXPECT_GT(plain, 100);
}

TEST(OsimExport, AllLengthsAgreeAtTheZeroPosture) {
  const auto X_WB = segmentPoses(reference().skeleton, zeroPosture(reference().skeleton));
  ForeignPosture q = defaultPosture(readBack());
  q.setZero();
  const Eigen::VectorXd length_m = foreignLengths(readBack(), q);
  for (const auto& unit : reference().musculature.units)
    EXPECT_NEAR(length_m[readBack().musculature.unitIndex(unit.name)], pathLength(unit, X_WB), kTenthOfAMillimetre_m)
        << unit.name;
}

/// The figures of docs/methods/model_exchange.md.
TEST(OsimExport, MovingPointsStandInBetterThanFixedOnes) {
  const LengthDeviation moving = lengthDeviation(reference(), readBack());
  const LengthDeviation fixed = lengthDeviation(
      reference(), foreignFromModel(reference(), {.blended = ForeignOptions::Blended::HeaviestAnchor}));
  std::printf("moving points: %s\nfixed points: %s\n", summaryText(moving).c_str(), summaryText(fixed).c_str());
  EXPECT_GE(moving.exactUnits(), fixed.exactUnits());
  EXPECT_LT(moving.medianOfMaxima_m(), 0.75 * fixed.medianOfMaxima_m());
}

/// A blend across the knee alone is a moving point exactly, as far as its splines go.
TEST(OsimExport, ABlendOverOneCoordinateIsExact) {
  Model model = reference();
  MusculotendonUnit& unit = model.musculature.units.front();
  model.musculature.units.resize(1);
  const int femur = model.skeleton.segmentIndex("femur_r"), tibia = model.skeleton.segmentIndex("tibia_r");
  const auto anchor = [](int segment, double weight, const Eigen::Vector3d& p_B) {
    return PathPoint{PathPointRole::Via, {{segment, weight, p_B}}, "", ""};
  };
  unit.path = {anchor(femur, 1, {-0.03, -0.1, 0}), anchor(femur, 0.6, {-0.03, -0.43, 0}),
               anchor(tibia, 1, {-0.03, -0.1, 0})};
  unit.path[1].anchors.push_back({tibia, 0.4, {-0.03, -0.008, 0}});
  const LengthDeviation deviation = lengthDeviation(model, foreignFromModel(model));
  EXPECT_EQ(deviation.exactUnits(), 1) << deviation.worst().max_norm_m;
}

/// Frames at and near the pole of their angles, obstacles, conditional points: what a reader gave is written back.
TEST(OsimExport, WhatWasReadIsWrittenBack) {
  for (const double y_deg : {-90.0, 90.0, 90.0 - 1e-7, 30.0}) {
    ForeignModel model = exported();
    RigidTransform X = RigidTransform::Identity();
    X.linear() = rotationAbout<double>(Eigen::Vector3d::UnitX(), 0.4) *
                 rotationAbout<double>(Eigen::Vector3d::UnitY(), y_deg * std::numbers::pi / 180) *
                 rotationAbout<double>(Eigen::Vector3d::UnitZ(), -0.7);
    model.joints[3].X_PF = X;
    model.wrap_objects.push_back({"roll", 2, X, WrapShape::Cylinder, {0.02, 0.02, 0.1}, 1, -1});
    model.paths[0].wraps.push_back({0, 0, -1});
    model.paths[1].points[1].condition = ForeignPathPoint::Condition{7, -0.2, 0.3};
    const ForeignModel back = osimFromText(osimText(model), "test.osim");
    EXPECT_LT((back.joints[3].X_PF.linear() - X.linear()).norm(), 1e-12) << y_deg;
    ASSERT_EQ(back.wrap_objects.size(), 1u);
    EXPECT_EQ(back.wrap_objects[0].radii_m, model.wrap_objects[0].radii_m);
    EXPECT_EQ(back.wrap_objects[0].side_sign, -1);
    EXPECT_EQ(back.paths[0].wraps.at(0).first_point, 0);
    ASSERT_TRUE(back.paths[1].points[1].condition);
    EXPECT_EQ(back.paths[1].points[1].condition->max, 0.3);
  }
}

TEST(OsimExport, NamesAndMusclesAreLegal) {
  Model model = reference();
  model.musculature.units.resize(2);
  model.musculature.units[0].name = model.musculature.units[1].name = "a b/c";
  model.name = "x -- <y>";
  OsimOptions options;
  options.muscles = OsimOptions::Muscles::Millard;
  options.remarks = {"one -- two"};
  const std::string text = osimText(foreignFromModel(model), options);
  const ForeignModel back = osimFromText(text, "test.osim");
  EXPECT_EQ(back.musculature.units[0].name, "a_b_c");
  EXPECT_EQ(back.musculature.units[1].name, "a_b_c_2");
  EXPECT_EQ(back.muscle_kinds[0], "Millard2012EquilibriumMuscle");
  EXPECT_THAT(text, ::testing::HasSubstr("OpenSimDocument Version=\"40000\""));
}

}  // namespace
}  // namespace sinew
