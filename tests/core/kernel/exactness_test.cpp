// Lengths, moment arms and point Jacobians of all units against differences of what they are derivatives of.
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <thread>

#include "core/muscle/load_musculature.h"
#include "core/muscle/muscle_path.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

constexpr int kPostures = 1000;
constexpr double kRelative = 1e-7;
/// [rad, m]. Points that come within 1.5 mm of each other at an extreme posture curve a length sharply: the error of
/// Richardson's extrapolation, h^4, is then 1e-9 of the arm; rounding of lengths is 1e-12 m per radian.
constexpr double kStep = 1e-4;

struct Body {
  Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  Musculature musculature = loadMusculature(test::resourceDir(), skeleton);
};

/// Posture from some coordinates: entries of q themselves, or clinical angles.
using Chart = Posture (*)(const Skeleton&, const Eigen::VectorXd&);

Posture ofItself(const Skeleton&, const Eigen::VectorXd& q) {
  return q;
}

/// The four postures of a central difference with Richardson's extrapolation: +-h, +-2h.
class Difference {
 public:
  Difference(const Skeleton& skeleton, Chart chart, const Eigen::VectorXd& x, int coordinate) {
    for (std::size_t i = 0; i < 4; ++i) {
      Eigen::VectorXd moved = x;
      moved[coordinate] += kSteps[i] * kStep;
      X_WB_[i] = segmentPoses(skeleton, chart(skeleton, moved));
    }
  }
  template <class Function>
  auto of(const Function& f) const {
    using Value = decltype(f(X_WB_[0]));
    const Value near = f(X_WB_[0]) - f(X_WB_[1]), far = f(X_WB_[2]) - f(X_WB_[3]);
    return Value{(8 * near - far) / (12 * kStep)};
  }
  /// Whether a segment moves at all: seen in its poses, not in the Jacobian that is tested.
  bool moves(std::size_t segment) const { return X_WB_[0][segment].matrix() != X_WB_[1][segment].matrix(); }

 private:
  static constexpr std::array<double, 4> kSteps{1, -1, 2, -2};
  std::array<std::vector<RigidTransform>, 4> X_WB_;
};

/// The patella's curve has corners of slope every few degrees of knee flexion, where a difference is none of a
/// derivative: knees are kept a step away from them.
void avoidCornersOfPatella(const Skeleton& skeleton, Eigen::VectorXd& clinical) {
  for (const auto& patella : skeleton.patellae)
    for (const double corner : patella.knee_flexion_rad)
      if (double& knee = clinical[patella.knee_coordinate]; std::abs(knee - corner) < 3 * kStep)
        knee = corner + 3 * kStep;
}

/// Middle angles of the sequences within 80 deg. At 90 deg (arm abducted in the frontal plane) flexion and rotation
/// turn about the same axis, and a moment arm about either is not defined by the posture.
Eigen::VectorXd awayFromGimbalLimit(const Skeleton& skeleton, Eigen::VectorXd clinical) {
  for (const Joint& joint : skeleton.joints)
    if (joint.type != JointType::Revolute) {
      double& middle = clinical[joint.first_coordinate + joint.coordinate_count - 2];
      middle = std::clamp(middle, -80 * std::numbers::pi / 180, 80 * std::numbers::pi / 180);
    }
  return clinical;
}

/// Largest error, in shares of the tolerance, of one posture.
struct Errors {
  double length_gradient = 0, point_jacobian = 0;
  void take(const Errors& other) {
    length_gradient = std::max(length_gradient, other.length_gradient);
    point_jacobian = std::max(point_jacobian, other.point_jacobian);
  }
};

/// Error of a vector in shares of 1e-7 of its length; below a millimetre per radian in shares of 0.1 nm.
double share(double error, double size_m) {
  return error / (kRelative * std::max(size_m, 1e-3));
}

Errors errorsAt(const Body& body, Chart chart, const Eigen::VectorXd& x, const Kinematics& k) {
  const Skeleton& s = body.skeleton;
  Errors errors;
  const auto units = static_cast<Eigen::Index>(body.musculature.units.size());
  Eigen::MatrixXd gradient(units, s.coordinateCount());
  for (Eigen::Index u = 0; u < units; ++u)
    gradient.row(u) = lengthGradient(body.musculature.units[static_cast<std::size_t>(u)], k).transpose();
  for (int c = 0; c < s.coordinateCount(); ++c) {
    const Difference d{s, chart, x, c};
    for (Eigen::Index u = 0; u < units; ++u) {
      const auto& unit = body.musculature.units[static_cast<std::size_t>(u)];
      bool moves = false;
      for (const auto& point : unit.path)
        for (const Anchor& a : point.anchors) {
          if (!d.moves(static_cast<std::size_t>(a.segment))) continue;
          moves = true;
          const Eigen::Vector3d velocity =
              d.of([&](const auto& X_WB) { return Eigen::Vector3d{X_WB[a.segment] * a.p_B}; });
          Eigen::Vector3d analytic = Eigen::Vector3d::Zero();
          for (const SegmentMotion& m : k.motions[a.segment])
            if (m.coordinate == c) analytic += m.twist.at(k.X_WB[a.segment] * a.p_B);
          errors.point_jacobian =
              std::max(errors.point_jacobian, share((analytic - velocity).norm(), velocity.norm()));
        }
      const double slope = moves ? d.of([&](const auto& X_WB) { return pathLength(unit, X_WB); }) : 0;
      errors.length_gradient =
          std::max(errors.length_gradient, share(std::abs(gradient(u, c) - slope), std::abs(slope)));
    }
  }
  return errors;
}

Errors errorsOver(const Body& body, int first, int last) {
  Errors errors;
  for (int i = first; i < last; ++i) {
    std::mt19937_64 random{static_cast<unsigned long>(i) + 1};
    Eigen::VectorXd clinical = awayFromGimbalLimit(body.skeleton, test::randomClinical(body.skeleton, random));
    avoidCornersOfPatella(body.skeleton, clinical);
    const Posture q = postureFromClinical(body.skeleton, clinical);
    // Half of the postures in either chart: what simulation uses, and what moment arms are taken about.
    errors.take(i % 2 == 0 ? errorsAt(body, ofItself, q, kinematics(body.skeleton, q))
                           : errorsAt(body, postureFromClinical, clinical, clinicalKinematics(body.skeleton, q)));
  }
  return errors;
}

TEST(Exactness, DerivativesOfAllUnitsAreThoseOfTheirLengthsAndPointsAtAThousandPostures) {
  const Body body;
  std::array<Errors, 2> halves;
  std::thread other{[&] { halves[1] = errorsOver(body, kPostures / 2, kPostures); }};
  halves[0] = errorsOver(body, 0, kPostures / 2);
  other.join();
  halves[0].take(halves[1]);
  RecordProperty("length_gradient_relative", std::to_string(kRelative * halves[0].length_gradient));
  RecordProperty("point_jacobian_relative", std::to_string(kRelative * halves[0].point_jacobian));
  std::printf("largest relative error: dl/dq %.1e, point Jacobian %.1e\n", kRelative * halves[0].length_gradient,
              kRelative * halves[0].point_jacobian);
  EXPECT_LT(halves[0].length_gradient, 1);
  EXPECT_LT(halves[0].point_jacobian, 1);
}

/// At the gimbal posture itself the posture's own coordinates stay exact; only the clinical ones lose an axis.
TEST(Exactness, HoldsAtTheGimbalPoseInTheCoordinatesOfThePosture) {
  const Body body;
  const Posture q = postureFromDegrees(body.skeleton, {{"shoulder_flexion_r", 20},
                                                       {"shoulder_adduction_r", -90},
                                                       {"shoulder_internal_rotation_r", 30},
                                                       {"knee_flexion_r", 5},
                                                       {"knee_flexion_l", 5}});
  const Errors errors = errorsAt(body, ofItself, q, kinematics(body.skeleton, q));
  EXPECT_LT(errors.length_gradient, 1);
  EXPECT_LT(errors.point_jacobian, 1);
}

}  // namespace
}  // namespace sinew
