#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"
#include "core/model/path_clearance.h"
#include "core/retarget/prepared/length_curve.h"
#include "core/retarget/prepared/reversals.h"
#include "core/retarget/prepared/shape_dependencies.h"
#include "core/skeleton/joint_motion.h"

namespace sinew {

/// One way of a coordinate, sampled: several motions of the table may run along it, there and back.
struct RoutingMotion {
  std::string name;               ///< of the first
  int coordinate = -1;            ///< clinical, that moves
  double weight = 1;              ///< how many
  std::vector<Posture> postures;  ///< kRoutingSamples, evenly from theta = 0 to 1
  std::vector<Posture> steps;     ///< the same more closely: kReversalSteps + 1
};
inline constexpr int kRoutingSamples = 11;
/// Steps of a motion between two samples.
inline constexpr int kStepsPerSample = kReversalSteps / (kRoutingSamples - 1);
static_assert(kStepsPerSample * (kRoutingSamples - 1) == kReversalSteps);

/// What one unit does in the reference over the motions that it takes part in: those whose coordinate it spans.
struct ReferenceCurves {
  std::vector<int> motions;                 ///< indices
  std::vector<Eigen::Vector3d> directions;  ///< unit, W; [motion][sample][segment of the path]
  std::vector<CurveFeatures> features;      ///< by motion, of lengths relative to that at the zero posture
  std::vector<double> lengths;              ///< the same lengths; [motion][sample]
  /// By motion: 1 where the unit is functionally significant - its length changes by more than kSignificantRange -,
  /// so that where it is longest and shortest has a meaning; else 0.
  std::vector<double> significance;
  std::vector<std::vector<double>> step_lengths;  ///< by motion: kReversalSteps + 1 lengths; empty if insignificant
  std::vector<std::vector<int>> step_directions;  ///< by motion: stepDirections() of these
  double zero_length_m = 0;
};
inline constexpr double kSignificantRange = 0.01;  ///< of the length at the zero posture

/// How a path point may move. Displacements are given in the reference body and carried over by the field.
struct PointGuide {
  /// Columns: directions of displacement in the frame of the heaviest anchor's segment. A via point moves freely; an
  /// attachment in the tangent plane of its bone (third column 0); all 0: it stays.
  Eigen::Matrix3d basis_B = Eigen::Matrix3d::Identity();
  bool attachment = false;
  int heaviest_anchor = 0;
  /// Nearest bone surface, of the segments that the point hangs on, in the frame of `surface_segment`.
  int surface_segment = -1;
  int bone = -1;  ///< of BoneDistances::bones()
  Eigen::Vector3d surface_B = Eigen::Vector3d::Zero();
  double clearance_m = 0;  ///< distance from there; negative inside
  /// Bones that it could come into: near ones, of all segments that the unit spans (an attachment: of its own).
  std::vector<int> near_bones;
};

/// Poses of all segments over all motions.
class MotionPoses {
 public:
  using Poses = std::vector<RigidTransform>;  ///< by segment
  MotionPoses(const Skeleton& skeleton, const std::vector<RoutingMotion>& motions);
  const Poses& at(int motion, int sample) const {
    return X_WB_[static_cast<std::size_t>(motion)][static_cast<std::size_t>(kStepsPerSample * sample)];
  }
  /// kReversalSteps + 1 of them.
  const std::vector<Poses>& over(int motion) const { return X_WB_[static_cast<std::size_t>(motion)]; }
  const Poses& atZero() const { return zero_; }

 private:
  std::vector<std::vector<Poses>> X_WB_;  ///< [motion][end of a step]
  Poses zero_;
};

/// Two directions of the tangent plane with this normal; third column 0.
Eigen::Matrix3d tangentBasis(const Eigen::Vector3d& normal);

/// Everything about the reference that routing needs, made once: some hundred milliseconds.
class RoutingReference {
 public:
  /// `reference` undeformed, with bones (without them attachments stay and via points are not guarded).
  RoutingReference(const Model& reference, const std::vector<JointMotion>& motions);

  const std::vector<RoutingMotion>& motions() const { return motions_; }
  const MotionPoses& poses() const { return poses_; }
  const ReferenceCurves& curves(std::size_t unit) const { return curves_[unit]; }
  const std::vector<PointGuide>& guides(std::size_t unit) const { return guides_[unit]; }
  const BoneDistances& bones() const { return bones_; }
  /// Index of the mirror image of each unit in the reference; -1 if its points are no mirror image.
  const std::vector<int>& mirrorOf() const { return mirror_of_; }
  const ShapeDependencies& dependencies() const { return dependencies_; }

 private:
  std::vector<RoutingMotion> motions_;
  MotionPoses poses_;
  std::vector<ReferenceCurves> curves_;
  std::vector<std::vector<PointGuide>> guides_;
  std::vector<int> mirror_of_;
  BoneDistances bones_;
  ShapeDependencies dependencies_;
};

}  // namespace sinew
