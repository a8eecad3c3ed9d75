#include "app/experiments/kept_functions.h"

#include <cmath>
#include <numbers>

#include "core/muscle/muscle_path.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

constexpr double kLeastShortening_m = 0.002, kLeastArm_m = 0.005, kStep = 1e-4;  // step: of theta, either way

/// Poses that tell what a unit does over one motion.
struct MotionEnds {
  std::vector<RigidTransform> start, end, before_middle, behind_middle;

  MotionEnds(const Skeleton& skeleton, const JointMotion& motion)
      : start{at(skeleton, motion, 0)},
        end{at(skeleton, motion, 1)},
        before_middle{at(skeleton, motion, 0.5 - kStep)},
        behind_middle{at(skeleton, motion, 0.5 + kStep)} {}

  double shortening_m(const MusculotendonUnit& unit) const { return pathLength(unit, start) - pathLength(unit, end); }
  /// Positive: turns the motion's way.
  double arm_m(const MusculotendonUnit& unit, double span_rad) const {
    return (pathLength(unit, before_middle) - pathLength(unit, behind_middle)) / (2 * kStep * span_rad);
  }

 private:
  static std::vector<RigidTransform> at(const Skeleton& skeleton, const JointMotion& motion, double theta) {
    return segmentPoses(skeleton, motionPosture(skeleton, motion, theta));
  }
};

}  // namespace

KeptFunctions keptFunctions(const RetargetReference& reference, const Model& body) {
  KeptFunctions kept;
  for (std::size_t m = 0; m < reference.motions().size(); ++m) {
    const JointMotion& motion = reference.motions()[m];
    const double span_rad = std::abs(motion.end_deg - motion.start_deg) * std::numbers::pi / 180;
    const MotionEnds before{reference.model().skeleton, motion}, now{body.skeleton, motion};
    for (const int u : reference.unitsOfMotion()[m]) {
      const MusculotendonUnit& unit = reference.model().musculature.units[std::size_t(u)];
      const MusculotendonUnit& moved = body.musculature.units[std::size_t(u)];
      bool lost = false;
      if (before.shortening_m(unit) >= kLeastShortening_m) {
        const bool keeps = now.shortening_m(moved) > 0;
        ++kept.shortenings, kept.shortenings_kept += keeps, lost |= !keeps;
      }
      if (before.arm_m(unit, span_rad) >= kLeastArm_m) {
        const bool keeps = now.arm_m(moved, span_rad) > 0;
        ++kept.moment_arms, kept.moment_arms_kept += keeps, lost |= !keeps;
      }
      if (lost) kept.lost.push_back(unit.name + ", " + motion.title);
    }
  }
  return kept;
}

}  // namespace sinew
