#include "core/posture/controllability.h"

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/optimization/bounded_least_squares.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<int> jointCoordinates(const Skeleton& skeleton) {
  std::vector<int> coordinates;
  for (int i = 0; i < skeleton.coordinateCount(); ++i)
    if (skeleton.joints[static_cast<std::size_t>(skeleton.coordinates[i].joint)].type != JointType::Free)
      coordinates.push_back(i);
  return coordinates;
}

/// Where the middle angle of a sequence is 90 deg, two clinical axes coincide and a torque about one of them alone
/// does not exist, whatever muscles there are: such a joint is looked at 1 deg beside.
Posture besideGimbalLimit(const Skeleton& skeleton, const Posture& posture) {
  constexpr double kRight_rad = std::numbers::pi / 2, kBeside_rad = std::numbers::pi / 180;
  Eigen::VectorXd clinical = clinicalFromPosture(skeleton, posture);
  for (const Joint& joint : skeleton.joints) {
    if (joint.type != JointType::Ball) continue;
    double& middle = clinical[joint.first_coordinate + 1];
    if (std::abs(std::abs(middle) - kRight_rad) < kBeside_rad)
      middle = std::copysign(kRight_rad - kBeside_rad, middle);
  }
  return postureFromClinical(skeleton, clinical);
}

/// R [N m]: coordinates x units.
MatrixXd torqueOfActivation(const Skeleton& skeleton, const Musculature& musculature, const Posture& posture,
                            const std::vector<int>& coordinates) {
  const Kinematics clinical = clinicalKinematics(skeleton, besideGimbalLimit(skeleton, posture));
  MatrixXd R(static_cast<Index>(coordinates.size()), static_cast<Index>(musculature.units.size()));
  for (Index j = 0; j < R.cols(); ++j) {
    const MusculotendonUnit& unit = musculature.units[static_cast<std::size_t>(j)];
    const double length_m = pathLength(unit, clinical.X_WB);
    const double added_N = equilibrium(unit, length_m, 1).force_N - equilibrium(unit, length_m, 0).force_N;
    R.col(j) = added_N * momentArms(unit, clinical)(coordinates);
  }
  return R;
}

double residualOf(const MatrixXd& R, const VectorXd& wanted) {
  const VectorXd none = VectorXd::Zero(R.cols());
  const VectorXd any = VectorXd::Constant(R.cols(), std::numeric_limits<double>::infinity());
  return solveBoundedLeastSquares(R, wanted, none, any).residual.norm();
}

/// Largest s with R a = s e, 0 <= a <= 1, as one bounded problem in (a, s): |R a - s e|^2 with so large a weight that
/// balance comes before s, which is pulled towards more than all units together can give.
double strengthOf(const MatrixXd& R, const VectorXd& wanted) {
  constexpr double kBalance = 1e4;
  const Index m = R.rows(), n = R.cols();
  const double goal_Nm = 2 * (wanted.transpose() * R).cwiseMax(0).sum();
  if (!(goal_Nm > 0)) return 0;
  MatrixXd A = MatrixXd::Zero(m + 1, n + 1);
  A.topLeftCorner(m, n) = kBalance / goal_Nm * R;
  A.topRightCorner(m, 1) = -kBalance * wanted;  // s in units of the goal
  A(m, n) = 1;
  VectorXd b = VectorXd::Zero(m + 1);
  b[m] = 1;
  const VectorXd none = VectorXd::Zero(n + 1), full = VectorXd::Ones(n + 1);
  return goal_Nm * solveBoundedLeastSquares(A, b, none, full).x[n];
}

template <class Fill>
std::vector<CoordinateControl> overDirections(const Skeleton& skeleton, const Musculature& musculature,
                                              const Posture& posture, const Fill& fill) {
  const std::vector<int> coordinates = jointCoordinates(skeleton);
  const MatrixXd R = torqueOfActivation(skeleton, musculature, posture, coordinates);
  std::vector<CoordinateControl> controls;
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const VectorXd up = VectorXd::Unit(R.rows(), static_cast<Index>(k));
    controls.push_back({coordinates[k], fill(R, up), fill(R, -up)});
  }
  return controls;
}

}  // namespace

std::vector<CoordinateControl> controllable(const Skeleton& skeleton, const Musculature& musculature,
                                            const Posture& posture) {
  return overDirections(skeleton, musculature, posture, [](const MatrixXd& R, const VectorXd& wanted) {
    return DirectionOfControl{.residual = residualOf(R, wanted)};
  });
}

std::vector<CoordinateControl> controllability(const Skeleton& skeleton, const Musculature& musculature,
                                               const Posture& posture) {
  return overDirections(skeleton, musculature, posture, [](const MatrixXd& R, const VectorXd& wanted) {
    return DirectionOfControl{residualOf(R, wanted), strengthOf(R, wanted)};
  });
}

}  // namespace sinew
