#include "core/muscle/evaluate.h"

#include <algorithm>

#include "core/error.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

std::vector<std::string> beyondEnvelope(const Skeleton& skeleton, const Posture& posture) {
  constexpr double kTolerance_rad = 1e-9;  // a posture typed in degrees may sit on the limit
  const Eigen::VectorXd clinical = clinicalFromPosture(skeleton, posture);
  std::vector<std::string> names;
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    const Coordinate& c = skeleton.coordinates[i];
    if (clinical[i] < c.athlete_min_rad - kTolerance_rad || clinical[i] > c.athlete_max_rad + kTolerance_rad)
      names.push_back(c.name);
  }
  return names;
}

}  // namespace

PostureEvaluation evaluatePosture(const Skeleton& skeleton, const Musculature& musculature, const Posture& posture) {
  const Kinematics clinical = clinicalKinematics(skeleton, posture);
  const auto count = static_cast<Eigen::Index>(musculature.units.size());
  PostureEvaluation e;
  e.length_m.resize(count);
  e.moment_arm_m.resize(count, skeleton.coordinateCount());
  e.normalized_fiber_length.resize(count);
  e.passive_force_N.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MusculotendonUnit& unit = musculature.units[static_cast<std::size_t>(i)];
    e.length_m[i] = pathLength(unit, clinical.X_WB);
    e.moment_arm_m.row(i) = momentArms(unit, clinical).transpose();
    const FiberState state = equilibrium(unit, e.length_m[i], 0);
    e.normalized_fiber_length[i] = state.normalized_fiber_length;
    e.passive_force_N[i] = state.force_N;
    e.margins.push_back({static_cast<int>(i), longestLength_m(unit) - e.length_m[i]});
  }
  e.passive_torque = e.moment_arm_m.transpose() * e.passive_force_N;
  std::ranges::stable_sort(e.margins, {}, &LengthMargin::margin_m);
  e.coordinates_beyond_envelope = beyondEnvelope(skeleton, posture);
  e.valid = e.coordinates_beyond_envelope.empty() && (e.margins.empty() || e.margins.front().margin_m >= 0);
  return e;
}

IsometricTorque isometricTorque(const Musculature& musculature, const PostureEvaluation& evaluation) {
  Eigen::VectorXd force_N(evaluation.length_m.size());
  for (Eigen::Index i = 0; i < force_N.size(); ++i)
    force_N[i] = equilibrium(musculature.units[static_cast<std::size_t>(i)], evaluation.length_m[i], 1).force_N;
  return {.increasing_Nm = evaluation.moment_arm_m.cwiseMax(0).transpose() * force_N,
          .decreasing_Nm = evaluation.moment_arm_m.cwiseMin(0).transpose() * force_N};
}

MotionCurve motionCurve(const Skeleton& skeleton, const MusculotendonUnit& unit, const JointMotion& motion,
                        int samples) {
  require(samples >= 2, "motionCurve: at least two samples");
  const int coordinate = skeleton.coordinateIndex(motion.coordinate);
  MotionCurve curve;
  for (int i = 0; i < samples; ++i) {
    const double theta = static_cast<double>(i) / (samples - 1);
    const Kinematics clinical = clinicalKinematics(skeleton, motionPosture(skeleton, motion, theta));
    const double length_m = pathLength(unit, clinical.X_WB), arm_m = momentArms(unit, clinical)[coordinate];
    const FiberState passive = equilibrium(unit, length_m, 0), full = equilibrium(unit, length_m, 1);
    curve.theta.push_back(theta);
    curve.angle_deg.push_back(motion.angle_deg(theta));
    curve.length_m.push_back(length_m);
    curve.moment_arm_m.push_back(arm_m);
    curve.normalized_fiber_length.push_back(passive.normalized_fiber_length);
    curve.passive_force_N.push_back(passive.force_N);
    curve.active_force_N.push_back(full.active_force_N);
    curve.full_torque_Nm.push_back(full.force_N * arm_m);
  }
  return curve;
}

}  // namespace sinew
