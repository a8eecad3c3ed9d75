#include "core/skeleton/shape/bone_field.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "core/error.h"
#include "core/skeleton/kinematics.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

const Skeleton& reference() {
  static const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  return skeleton;
}

double jointDistance(const Skeleton& s, const char* a, const char* b) {
  const auto X = segmentPoses(s, zeroPosture(s));
  return (X[s.segmentIndex(a)].translation() - X[s.segmentIndex(b)].translation()).norm();
}

TEST(BoneField, IdentityMovesNothing) {
  const Skeleton s = deformedSkeleton(reference(), {});
  for (std::size_t i = 0; i < s.landmarks.size(); ++i)
    EXPECT_LT((s.landmarks[i].p_BL - reference().landmarks[i].p_BL).norm(), 1e-15) << s.landmarks[i].name;
  for (std::size_t i = 0; i < s.joints.size(); ++i)
    EXPECT_TRUE(s.joints[i].X_PJ.isApprox(reference().joints[i].X_PJ, 1e-15));
}

TEST(BoneField, ElongationIsTheRatioOfJointDistancesWhateverTheHeads) {
  ShapeParameters shape;
  shape.sides[0].femur = {.elongation = 1.2, .proximal_scale = 0.9, .distal_scale = 1.15, .torsion_rad = 0.3};
  shape.sides[1].tibia.elongation = 0.7;
  const Skeleton s = deformedSkeleton(reference(), shape);
  EXPECT_NEAR(jointDistance(s, "femur_r", "tibia_r"), 1.2 * 0.422, 1e-12);
  EXPECT_NEAR(jointDistance(s, "tibia_l", "foot_l"), 0.7 * 0.430, 1e-12);
  EXPECT_NEAR(jointDistance(s, "femur_l", "tibia_l"), 0.422, 1e-12);  // the other side stays
}

TEST(BoneField, TorsionTurnsTheDistalJointOutwardsOnBothSides) {
  ShapeParameters shape;
  for (auto& side : shape.sides) side.femur.torsion_rad = 20 * kDeg;
  const Skeleton s = deformedSkeleton(reference(), shape);
  const auto X = segmentPoses(s, zeroPosture(s));
  const Eigen::Vector3d toes_r = X[s.segmentIndex("foot_r")].linear().col(0);
  const Eigen::Vector3d toes_l = X[s.segmentIndex("foot_l")].linear().col(0);
  EXPECT_NEAR(std::atan2(toes_r.z(), toes_r.x()), 20 * kDeg, 1e-12);  // right foot points to the right
  EXPECT_NEAR(std::atan2(toes_l.z(), toes_l.x()), -20 * kDeg, 1e-12);
}

TEST(BoneField, VarusBringsTheAnkleInwards) {
  ShapeParameters shape;
  for (auto& side : shape.sides) side.femur.varus_rad = 5 * kDeg;
  const Skeleton s = deformedSkeleton(reference(), shape);
  const auto X = segmentPoses(s, zeroPosture(s));
  EXPECT_NEAR(X[s.segmentIndex("foot_r")].translation().z(), 0.086 - 0.430 * std::sin(5 * kDeg), 1e-12);
  EXPECT_NEAR(X[s.segmentIndex("foot_l")].translation().z(), -0.086 + 0.430 * std::sin(5 * kDeg), 1e-12);
}

/// Where a landmark lies at the zero posture.
Eigen::Vector3d place(const Skeleton& s, const std::string& landmark) {
  const Landmark& l = s.landmark(landmark);
  return segmentPoses(s, zeroPosture(s))[std::size_t(l.segment)] * l.p_BL;
}

TEST(BoneField, ASubluxatedHipTakesTheWholeLegAlong) {
  ShapeParameters shape;
  for (auto& side : shape.sides) side.hip = {.lateral_m = 0.015, .superior_m = 0.02, .anterior_m = -0.005};
  const Skeleton s = deformedSkeleton(reference(), shape);
  for (const std::string side : {"_r", "_l"}) {
    const Eigen::Vector3d shift{-0.005, 0.02, side == "_r" ? 0.015 : -0.015};
    for (const std::string name : {"femoral_head_center", "medial_epicondyle", "medial_malleolus", "calcaneus"})
      EXPECT_LT((place(s, name + side) - place(reference(), name + side) - shift).norm(), 1e-15) << name << side;
    EXPECT_EQ(place(s, "acetabulum_center" + side), place(reference(), "acetabulum_center" + side));
  }
}

TEST(BoneField, BendsKeepTheDistanceOfTheJointsAndHaveTheirSigns) {
  constexpr double kAngle = 10 * kDeg;
  const auto bent = [&](double LimbBoneShape::*angle, LimbBoneShape SideShape::*bone) {
    ShapeParameters shape;
    for (auto& side : shape.sides) side.*bone.*angle = kAngle;
    const Skeleton s = deformedSkeleton(reference(), shape);
    EXPECT_NEAR(jointDistance(s, "femur_r", "tibia_r"), 0.422, 1e-12);
    EXPECT_NEAR(jointDistance(s, "tibia_l", "foot_l"), 0.430, 1e-12);
    return s;
  };
  const auto moved = [&](const Skeleton& s, const std::string& landmark) {
    return Eigen::Vector3d{place(s, landmark) - place(reference(), landmark)};
  };
  const double reach = 0.430 * std::sin(kAngle);
  for (const std::string side : {"_r", "_l"}) {
    const double inwards = side == "_r" ? -1 : 1;
    Skeleton s = bent(&LimbBoneShape::varus_rad, &SideShape::tibia);
    EXPECT_NEAR(inwards * moved(s, "ankle_center" + side).z(), reach, 1e-12);
    EXPECT_LT(moved(s, "medial_plateau_center" + side).norm(), 1e-15);  // above the bend
    s = bent(&LimbBoneShape::procurvatum_rad, &SideShape::tibia);
    EXPECT_NEAR(moved(s, "ankle_center" + side).x(), -reach, 1e-12);  // backwards
    s = bent(&LimbBoneShape::procurvatum_rad, &SideShape::femur);
    EXPECT_NEAR(moved(s, "ankle_center" + side).x(), -reach, 1e-12);
    s = bent(&LimbBoneShape::distal_varus_rad, &SideShape::tibia);
    EXPECT_LT(moved(s, "ankle_center" + side).norm(), 1e-15);
    EXPECT_GT(inwards * moved(s, "calcaneus" + side).z(), 0.045 * std::sin(kAngle) - 1e-12);
    // A bow moves the middle of the shaft and turns the ends against each other by its angle, half of it each.
    s = bent(&LimbBoneShape::bow_frontal_rad, &SideShape::femur);
    EXPECT_LT(inwards * moved(s, "femoral_shaft_middle" + side).z(), -0.012);  // outwards
    EXPECT_NEAR(inwards * moved(s, "ankle_center" + side).z(), 0.430 * std::sin(kAngle / 2), 1e-12);
    s = bent(&LimbBoneShape::bow_sagittal_rad, &SideShape::femur);
    EXPECT_GT(moved(s, "femoral_shaft_middle" + side).x(), 0.012);  // forwards
    EXPECT_NEAR(moved(s, "ankle_center" + side).x(), -0.430 * std::sin(kAngle / 2), 1e-12);
  }
}

TEST(BoneField, TheNeckHasItsOwnLengthAndBend) {
  const auto neck = [&](const Skeleton& s) {  // from the head's centre to the neck's base, right femur
    return Eigen::Vector3d{s.landmark("femoral_neck_base_r").p_BL - s.landmark("femoral_head_center_r").p_BL};
  };
  const Eigen::Vector3d before = neck(reference());
  ShapeParameters shape;
  shape.sides[0].femur.proximal_scale = 0.8;
  shape.sides[0].femur.neck_length_m = -0.012;
  Skeleton s = deformedSkeleton(reference(), shape);
  EXPECT_NEAR(neck(s).norm(), 0.8 * before.norm() - 0.012, 1e-9);                    // the scaled neck, 12 mm shorter
  EXPECT_LT(neck(s).cross(before).norm() / (neck(s).norm() * before.norm()), 1e-9);  // along its axis
  EXPECT_NEAR(jointDistance(s, "femur_r", "tibia_r"), 0.422, 1e-12);
  shape = {};
  shape.sides[0].femur.neck_varus_rad = 15 * kDeg;
  s = deformedSkeleton(reference(), shape);
  EXPECT_GT(neck(s).y(), before.y() + 0.009);  // the base stands higher against the head
  EXPECT_NEAR(neck(s).norm(), before.norm(), 1e-9);
  shape = {};
  shape.sides[0].femur.neck_retroversion_rad = 15 * kDeg;
  s = deformedSkeleton(reference(), shape);
  EXPECT_GT(neck(s).x(), before.x() + 0.009);  // ... or further in front
  EXPECT_EQ(s.landmark("femoral_head_center_r").p_BL, reference().landmark("femoral_head_center_r").p_BL);
}

TEST(BoneField, HeadsStayRigidUpToTheirScale) {
  ShapeParameters shape;
  shape.sides[0].femur = {.elongation = 1.3, .proximal_scale = 1.1, .distal_scale = 0.9, .torsion_rad = 0.4};
  const std::vector<double> x = toVector(shape);
  const int femur = reference().segmentIndex("femur_r");
  const Eigen::Vector3d a{0.02, -0.40, -0.03}, b{-0.03, -0.43, 0.02};  // both in the distal head
  EXPECT_NEAR((deform(reference(), x, femur, a) - deform(reference(), x, femur, b)).norm(), 0.9 * (a - b).norm(),
              1e-12);
}

/// Jacobian by central differences.
Eigen::Matrix3d jacobian(const std::vector<double>& x, int segment, const Eigen::Vector3d& p) {
  constexpr double h = 1e-6;
  Eigen::Matrix3d J;
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d d = Eigen::Vector3d::Zero();
    d[i] = h;
    J.col(i) = (deform(reference(), x, segment, Eigen::Vector3d{p + d}) -
                deform(reference(), x, segment, Eigen::Vector3d{p - d})) /
               (2 * h);
  }
  return J;
}

TEST(BoneField, IsSmoothAndNeverTurnsInsideOut) {
  ShapeParameters shape;
  shape.trunk_bend_rad = 20 * kDeg;
  shape.sides[0].femur = {.elongation = 0.75,
                          .proximal_scale = 1.1,
                          .distal_scale = 0.9,
                          .torsion_rad = 30 * kDeg,
                          .neck_shaft_rad = 10 * kDeg,
                          .varus_rad = 8 * kDeg,
                          .procurvatum_rad = 5 * kDeg,
                          .neck_length_m = -0.006,
                          .neck_varus_rad = -6 * kDeg,
                          .bow_frontal_rad = 6 * kDeg,
                          .bow_sagittal_rad = 8 * kDeg};
  shape.sides[0].tibia = {.elongation = 1.3,
                          .proximal_scale = 0.8,
                          .distal_scale = 1.2,
                          .torsion_rad = -30 * kDeg,
                          .varus_rad = 10 * kDeg,
                          .procurvatum_rad = -6 * kDeg,
                          .distal_varus_rad = 8 * kDeg};
  const std::vector<double> x = toVector(shape);
  for (const char* name : {"femur_r", "tibia_r", "ulna_r", "thorax"}) {
    const int segment = reference().segmentIndex(name);
    for (double y = 0.03; y > -0.46; y -= 0.002)
      for (const double z : {-0.03, 0.0, 0.05}) {
        const Eigen::Matrix3d J = jacobian(x, segment, {0.015, y, z});
        EXPECT_GT(J.determinant(), 0.05) << name << " y " << y << " z " << z;
        const Eigen::Matrix3d next = jacobian(x, segment, {0.015, y - 1e-4, z});
        EXPECT_LT((next - J).cwiseAbs().maxCoeff(), 0.02) << name << " jumps at y " << y;  // C1: no step in 0.1 mm
      }
  }
}

TEST(BoneField, RefusesABoneShorterThanItsHeads) {
  ShapeParameters shape;
  shape.sides[1].femur.elongation = 0.35;
  try {
    deformedSkeleton(reference(), shape);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string{error.what()}.find("femur_l.elongation"), std::string::npos);
  }
}

TEST(ShapeParameters, FlatListGoesBothWays) {
  ShapeParameters shape;
  shape.sides[1].hand_scale = 0.8;
  shape.sides[0].femur.varus_rad = 0.1;
  EXPECT_EQ(shapeFromVector(toVector(shape)), shape);
  EXPECT_EQ(shapeParameterNames().size(), toVector(shape).size());
  EXPECT_EQ(shapeParameterNames().front(), "pelvis.width");
  EXPECT_EQ(shapeParameterNames().back(), "hip_l.anterior");
}

}  // namespace
}  // namespace sinew
