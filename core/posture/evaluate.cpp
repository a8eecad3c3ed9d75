#include "core/posture/evaluate.h"

#include <algorithm>

#include "core/error.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/passive/structure_moments.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {

void fillPassive(const Musculature& musculature, PostureEvaluation& e) {
  e.normalized_fiber_length.resize(e.length_m.size());
  e.passive_force_N.resize(e.length_m.size());
  for (Eigen::Index i = 0; i < e.length_m.size(); ++i) {
    const FiberState state = equilibrium(musculature.units[static_cast<std::size_t>(i)], e.length_m[i], 0);
    e.normalized_fiber_length[i] = state.normalized_fiber_length;
    e.passive_force_N[i] = state.force_N;
  }
  e.passive_torque = e.moment_arm_m.transpose() * e.passive_force_N;
  if (e.structure_torque.size() > 0) e.passive_torque += e.structure_torque;
}

PostureEvaluation evaluatePosture(const Skeleton& skeleton, const Musculature& musculature, const Posture& posture,
                                  const PassiveMoments& structures) {
  const Kinematics clinical = clinicalKinematics(skeleton, posture);
  const auto count = static_cast<Eigen::Index>(musculature.units.size());
  PostureEvaluation e;
  e.length_m.resize(count);
  e.moment_arm_m.resize(count, skeleton.coordinateCount());
  for (Eigen::Index i = 0; i < count; ++i) {
    const MusculotendonUnit& unit = musculature.units[static_cast<std::size_t>(i)];
    e.length_m[i] = pathLength(unit, clinical.X_WB);
    e.moment_arm_m.row(i) = momentArms(unit, clinical).transpose();
  }
  e.structure_torque = structureMoments_Nm(skeleton, structures, posture);
  fillPassive(musculature, e);
  const auto constraints = constraintMargins(skeleton, musculature, posture);
  for (const ConstraintMargin& c : constraints) {
    if (c.kind == ConstraintKind::MuscleLength) e.margins.push_back({c.index, c.margin});
    if (c.kind == ConstraintKind::JointStop && !c.holds())
      e.coordinates_beyond_envelope.push_back(skeleton.coordinates[static_cast<std::size_t>(c.index)].name);
  }
  std::ranges::stable_sort(e.margins, {}, &LengthMargin::margin_m);
  const Validity v = validityOf(constraints);
  e.valid = v.valid;
  e.first_to_fail = v.first;
  return e;
}

IsometricTorque isometricTorque(const Musculature& musculature, const PostureEvaluation& evaluation) {
  Eigen::VectorXd force_N(evaluation.length_m.size());
  for (Eigen::Index i = 0; i < force_N.size(); ++i)
    force_N[i] = equilibrium(musculature.units[static_cast<std::size_t>(i)], evaluation.length_m[i], 1).force_N;
  return {.increasing_Nm = evaluation.moment_arm_m.cwiseMax(0).transpose() * force_N,
          .decreasing_Nm = evaluation.moment_arm_m.cwiseMin(0).transpose() * force_N};
}

void appendSample(const MusculotendonUnit& unit, double theta, double angle_deg, double length_m, double moment_arm_m,
                  MotionCurve& curve) {
  const FiberState passive = equilibrium(unit, length_m, 0), full = equilibrium(unit, length_m, 1);
  curve.theta.push_back(theta);
  curve.angle_deg.push_back(angle_deg);
  curve.length_m.push_back(length_m);
  curve.moment_arm_m.push_back(moment_arm_m);
  curve.normalized_fiber_length.push_back(passive.normalized_fiber_length);
  curve.passive_force_N.push_back(passive.force_N);
  curve.active_force_N.push_back(full.active_force_N);
  curve.full_torque_Nm.push_back(full.force_N * moment_arm_m);
}

MotionCurve motionCurve(const Skeleton& skeleton, const MusculotendonUnit& unit, const JointMotion& motion,
                        int samples) {
  require(samples >= 2, "motionCurve: at least two samples");
  const int coordinate = skeleton.coordinateIndex(motion.coordinate);
  MotionCurve curve;
  for (int i = 0; i < samples; ++i) {
    const double theta = static_cast<double>(i) / (samples - 1);
    const Kinematics clinical = clinicalKinematics(skeleton, motionPosture(skeleton, motion, theta));
    appendSample(unit, theta, motion.angle_deg(theta), pathLength(unit, clinical.X_WB),
                 momentArms(unit, clinical)[coordinate], curve);
  }
  return curve;
}

}  // namespace sinew
