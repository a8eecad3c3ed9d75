#include "app/experiments/moment_arm_curves.h"

#include <numeric>

#include "core/muscle/unit_selection.h"
#include "core/posture/evaluate.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

MomentArmCurve curveOf(const Model& model, const std::string& body, const std::vector<int>& units,
                       const JointMotion& motion, int samples) {
  MomentArmCurve curve{body, std::vector<double>(std::size_t(samples), 0.0)};
  const double way = motion.end_deg > motion.start_deg ? 1 : -1;
  double force_N = 0;
  for (const int u : units) {
    const MusculotendonUnit& unit = model.musculature.units[std::size_t(u)];
    const MotionCurve swept = motionCurve(model.skeleton, unit, motion, samples);
    for (std::size_t i = 0; i < curve.arm_m.size(); ++i)
      curve.arm_m[i] += way * unit.max_isometric_force_N * swept.moment_arm_m[i];
    force_N += unit.max_isometric_force_N;
  }
  for (double& arm_m : curve.arm_m) arm_m /= force_N;
  curve.mean_m = std::accumulate(curve.arm_m.begin(), curve.arm_m.end(), 0.0) / double(curve.arm_m.size());
  return curve;
}

/// Units of the right side that turn the reference the motion's way.
std::vector<int> turning(const RetargetReference& reference, const JointMotion& motion, int samples) {
  std::vector<int> units;
  const auto& all = reference.model().musculature.units;
  for (std::size_t u = 0; u < all.size(); ++u)
    if (all[u].name.ends_with("_r") &&
        curveOf(reference.model(), "", {static_cast<int>(u)}, motion, samples).mean_m > 0)
      units.push_back(static_cast<int>(u));
  return units;
}

}  // namespace

std::vector<MomentArmQuestion> hipMomentArms() {
  return {{"", "hip_extension"}, {"", "hip_flexion"}};
}

std::vector<MomentArmQuestion> paperMomentArms() {
  return {
      {"gluteus_maximus_r", "hip_extension"}, {"iliacus_r", "hip_flexion"}, {"rectus_femoris_r", "knee_extension"}};
}

MomentArmFigure momentArmFigure(const RetargetReference& reference, std::span<const Character> characters,
                                const MomentArmQuestion& question, int samples) {
  const JointMotion& motion = findMotion(reference.motions(), question.motion);
  const std::vector<int> units = question.muscle.empty() ? turning(reference, motion, samples)
                                                         : unitsNamed(reference.model().musculature, question.muscle);
  MomentArmFigure figure{question, motion.title, motion.coordinate, {}, {}};
  for (int i = 0; i < samples; ++i) figure.angle_deg.push_back(motion.angle_deg(double(i) / (samples - 1)));
  figure.curves.push_back(curveOf(reference.model(), "reference", units, motion, samples));
  for (const Character& c : characters)
    figure.curves.push_back(curveOf(c.retargeted.model, c.body.name, units, motion, samples));
  return figure;
}

}  // namespace sinew
