#pragma once
#include <string>
#include <vector>

#include "core/io/motion/bvh.h"
#include "core/job.h"
#include "core/rom/poses/pose_set.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// Postures of our skeleton from a recorded motion of another one (CMU-style names: Hips, Spine, LeftUpLeg,
// LeftForeArm
// ...). Proportions differ, so neither points nor angles are copied: inverse kinematics turns our segments the way
// theirs are turned. The rest pose of the file (a T) is met by our skeleton first, which ties segment to joint; then
// in every frame trunk, girdle, feet, head and hands take the turns of their joints, thighs, shanks, arms and
// forearms the directions of their bones. The forearm's twist comes out between elbow (a hinge here) and hand,
// wherever the file keeps it. See docs/methods/range_of_motion.md.

struct MotionImportOptions {
  int step = 1;             ///< every step-th frame
  int iterations = 30;      ///< of the solver, a frame
  double tolerance = 1e-6;  ///< of a step [rad], at which a frame is done
};

struct MotionImport {
  PoseSet poses;
  int frames = 0;      ///< of the file
  double scale = 1;    ///< metres per unit of the file, by the length of the legs
  double rms_deg = 0;  ///< between directions of limbs in the file and ours
  double worst_deg = 0;
  int worst_frame = -1;
  std::string worst_segment;
  std::vector<std::string> unused;  ///< joints of the file that say nothing about our segments
};

/// @throws InputError if joints that the body needs are missing (naming them), or the rest pose is no human's.
MotionImport importMotion(const BvhMotion& motion, const std::string& where, const Skeleton& skeleton,
                          const MotionImportOptions& options = {}, const Job& job = {});

/// The other way: a CMU-style skeleton with our proportions at rest in a T, in centimetres, X to the left, Y up, Z
/// forward, and its frames. What an importer can be proved with, and other programs read.
BvhMotion motionFromPostures(const Skeleton& skeleton, const std::vector<Posture>& postures, double frame_time_s);

}  // namespace sinew
