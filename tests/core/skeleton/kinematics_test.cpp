#include "core/skeleton/kinematics.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "core/error.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

const Skeleton& reference() {
  static const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  return skeleton;
}

/// Clinical coordinates drawn inside the athlete envelope.
Eigen::VectorXd randomClinical(const Skeleton& s, std::mt19937_64& random) {
  Eigen::VectorXd x(s.coordinateCount());
  for (int i = 0; i < x.size(); ++i) {
    const Coordinate& c = s.coordinates[i];
    const double t = std::generate_canonical<double, 53>(random);
    const double low = std::max(c.athlete_min_rad, -80 * kDeg), high = std::min(c.athlete_max_rad, 150 * kDeg);
    x[i] = low + t * (high - low);
  }
  return x;
}

Posture mirroredPosture(const Skeleton& s, const Eigen::VectorXd& clinical) {
  Eigen::VectorXd m = clinical;
  for (int i = 0; i < m.size(); ++i) {
    std::string name = s.coordinates[i].name;
    if (name.ends_with("_r") || name.ends_with("_l")) {
      name.back() = name.back() == 'r' ? 'l' : 'r';
      m[s.coordinateIndex(name)] = clinical[i];
    } else if (name == "pelvis_tz" || name.ends_with("list") || name.ends_with("rotation") ||
               name.ends_with("lateral_flexion")) {
      m[i] = -clinical[i];
    }
  }
  return postureFromClinical(s, m);
}

TEST(ReferenceSkeleton, HasTheBodiesJointsAndCoordinatesOfThePaper) {
  const Skeleton& s = reference();
  EXPECT_EQ(s.segments.size(), 23u);
  EXPECT_EQ(s.movingSegmentCount(), 19);
  EXPECT_EQ(s.coordinateCount(), 50);
  EXPECT_EQ(std::ranges::count(s.joints, JointType::Revolute, &Joint::type), 5);
  EXPECT_EQ(std::ranges::count(s.joints, JointType::Ball, &Joint::type), 13);
  double mass_kg = 0;
  for (const auto& segment : s.segments) mass_kg += segment.mass_kg;
  EXPECT_NEAR(mass_kg, 73.0, 0.01);  // de Leva 1996
}

TEST(ReferenceSkeleton, NamesTheNearestWhenAskedForAWrongName) {
  try {
    reference().coordinateIndex("knee_flexon_r");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string{error.what()}.find("knee_flexion_r"), std::string::npos);
  }
}

TEST(Kinematics, PatellaGlidesAlongThePublishedCurve) {
  const Skeleton& s = reference();
  const auto [phi, slope] = s.patellae[0].glide(90 * kDeg);
  // Trapezoids of the table up to 90 deg, divided by the circle's radius.
  const double integral = 15 * kDeg * (0.046 / 2 + 0.047 + 0.046 + 0.042 + 0.037 + 0.031 + 0.026 / 2);
  EXPECT_NEAR(phi, integral / 0.046, 1e-12);
  EXPECT_NEAR(slope, 0.026 / 0.046, 1e-12);
}

TEST(Kinematics, PointJacobianMatchesCentralDifferences) {
  const Skeleton& s = reference();
  std::mt19937_64 random{7};
  constexpr double h = 1e-6;
  double worst = 0;
  for (int draw = 0; draw < 20; ++draw) {
    const Posture q = postureFromClinical(s, randomClinical(s, random));
    const Kinematics k = kinematics(s, q);
    for (int b = 0; b < int(s.segments.size()); ++b) {
      const Eigen::Vector3d p{0.03, -0.11, 0.02};
      const Eigen::Matrix3Xd J = pointJacobian(s, k, b, p);
      for (int c = 0; c < s.coordinateCount(); ++c) {
        Posture plus = q, minus = q;
        plus[c] += h;
        minus[c] -= h;
        const Eigen::Vector3d difference = (segmentPoses(s, plus)[b] * p - segmentPoses(s, minus)[b] * p) / (2 * h);
        worst = std::max(worst, (J.col(c) - difference).norm());
      }
    }
  }
  EXPECT_LT(worst, 1e-7);  // m/rad; the rounding of a central difference with h = 1e-6 is about 1e-9
}

TEST(Kinematics, LeftIsTheMirrorImageOfRight) {
  const Skeleton& s = reference();
  std::mt19937_64 random{11};
  for (int draw = 0; draw < 10; ++draw) {
    const Eigen::VectorXd clinical = randomClinical(s, random);
    const auto X = segmentPoses(s, postureFromClinical(s, clinical));
    const auto Y = segmentPoses(s, mirroredPosture(s, clinical));
    for (std::size_t b = 0; b < s.segments.size(); ++b) {
      std::string name = s.segments[b].name;
      if (name.ends_with("_r"))
        name.back() = 'l';
      else if (name.ends_with("_l"))
        name.back() = 'r';
      const RigidTransform expected = mirrored(X[b]);
      EXPECT_TRUE(Y[s.segmentIndex(name)].isApprox(expected, 1e-9)) << name;
    }
  }
}

TEST(ClinicalAngles, KeepTheirMeaningOnBothSides) {
  const Skeleton& s = reference();
  const auto pointAt = [&](const std::map<std::string, double>& deg, const char* segment, Eigen::Vector3d p) {
    return Eigen::Vector3d{segmentPoses(s, postureFromDegrees(s, deg))[s.segmentIndex(segment)] * p};
  };
  const Eigen::Vector3d knee{0, -0.422, 0};
  EXPECT_GT(pointAt({{"hip_flexion_r", 30}}, "femur_r", knee).x(), 0.2);    // knee moves forward
  EXPECT_GT(pointAt({{"hip_adduction_l", 30}}, "femur_l", knee).z(), 0.1);  // left knee moves to the right
  EXPECT_LT(pointAt({{"knee_flexion_l", 90}}, "tibia_l", knee).x(), -0.4);  // heel moves back
  EXPECT_GT(pointAt({{"ankle_dorsiflexion_r", 20}}, "foot_r", {0.15, 0, 0}).y(), 0.1);       // toes rise
  EXPECT_GT(pointAt({{"hip_internal_rotation_l", 30}}, "foot_l", {0.15, 0, 0}).z(), -0.03);  // toes turn inwards
  EXPECT_LT(pointAt({{"forearm_pronation_r", 90}}, "hand_r", {0, 0, 0.03}).z(),
            0.16);  // pronated thumb points inwards
  EXPECT_GT(pointAt({{"lumbar_flexion", 40}}, "thorax", {0, 0.2, 0}).x(), 0.1);
}

TEST(ClinicalKinematics, DifferentiatesTheClinicalAngles) {
  const Skeleton& s = reference();
  std::mt19937_64 random{5};
  constexpr double h = 1e-6;
  for (int draw = 0; draw < 5; ++draw) {
    const Eigen::VectorXd clinical = 0.5 * randomClinical(s, random);
    const Kinematics k = clinicalKinematics(s, postureFromClinical(s, clinical));
    const Eigen::Vector3d p{0.02, -0.1, 0.01};
    for (const char* name : {"foot_r", "hand_l", "radius_r", "patella_l", "head"}) {
      const int b = s.segmentIndex(name);
      const Eigen::Matrix3Xd J = pointJacobian(s, k, b, p);
      for (int c = 0; c < s.coordinateCount(); ++c) {
        Eigen::VectorXd plus = clinical, minus = clinical;
        plus[c] += h;
        minus[c] -= h;
        const Eigen::Vector3d d = (segmentPoses(s, postureFromClinical(s, plus))[b] * p -
                                   segmentPoses(s, postureFromClinical(s, minus))[b] * p) /
                                  (2 * h);
        EXPECT_LT((J.col(c) - d).norm(), 1e-7) << name << " " << s.coordinates[c].name;
      }
    }
  }
}

}  // namespace
}  // namespace sinew
