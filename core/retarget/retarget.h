#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"
#include "core/retarget/lengths/maximal_lengths.h"
#include "core/retarget/peaks/peak_torque.h"
#include "core/retarget/prepared/range_samples.h"
#include "core/retarget/prepared/routing_reference.h"
#include "core/retarget/routing/routing.h"
#include "core/rom/poses/pose_set.h"
#include "core/skeleton/joint_motion.h"

namespace sinew {

// Function-preserving retargeting (Ryu et al., Musculature Retargeting): the muscles of a reference in a new body, in
// three steps, each of which keeps what the one before it reached: routing (directions and length curves), maximal
// lengths (ranges of motion), fibre : tendon ratios (angles of peak torque). docs/methods/retargeting.md.

/// The reference with all that retargeting asks of it again and again; made once (about a second), then constant and
/// shared between threads.
class RetargetReference {
 public:
  /// `model` undeformed; its lengths are those that the new body is to correspond to (an examination's included).
  RetargetReference(Model model, std::vector<JointMotion> motions, std::shared_ptr<const PoseSet> poses);

  const Model& model() const { return model_; }
  const std::vector<JointMotion>& motions() const { return motions_; }
  const PoseSet& poses() const { return *poses_; }
  const RoutingReference& routing() const { return routing_; }
  const std::vector<double>& longest_m() const { return longest_m_; }  ///< longestOverPoses()
  const RangeSamples& ranges() const { return ranges_; }
  const PoseTable& torquePostures() const { return torque_postures_; }
  const std::vector<std::vector<int>>& unitsOfMotion() const { return units_of_motion_; }
  const std::vector<int>& mirrorMotionOf() const { return mirror_motion_of_; }  ///< by motion, see mirrorMotions()
  const std::vector<double>& peakThetas() const { return peak_thetas_; }        ///< by motion

 private:
  Model model_;
  std::vector<JointMotion> motions_;
  std::shared_ptr<const PoseSet> poses_;
  RoutingReference routing_;
  std::vector<double> longest_m_;
  RangeSamples ranges_;
  PoseTable torque_postures_;
  std::vector<std::vector<int>> units_of_motion_;
  std::vector<int> mirror_motion_of_;
  std::vector<double> peak_thetas_;
};

/// The reference model of a preset with the joint motions and the synthetic pose set that belong to it.
std::shared_ptr<const RetargetReference> loadRetargetReference(const std::filesystem::path& resource_dir,
                                                               std::string_view preset = "average-adult");

struct RetargetOptions {
  RetargetMethod method = RetargetMethod::Sinew;
  RoutingWeights weights;
  bool peak_torque = true;  ///< step 3
  /// Masses and strengths (core/model/physical_scaling.h), which peak torques depend on; nullopt: those of
  /// deformedModel().
  std::optional<PhysicsFactors> physics;
};

struct RetargetTimes {
  double deformation_s = 0, routing_s = 0, lengths_s = 0, peak_torque_s = 0;
  double total_s() const { return deformation_s + routing_s + lengths_s + peak_torque_s; }
};

struct Retargeted {
  Outcome outcome = Outcome::NotRun;
  Model model;                               ///< if converged
  std::vector<UnitRouting> routing;          ///< by unit; naive: start and end are the same
  MaximalLengths lengths;                    ///< naive: not run
  std::vector<PeakTorqueAngle> peak_torque;  ///< by motion; naive: before and after are the same
  std::vector<double> fiber_tendon_ratio;    ///< by unit, relative to the reference's
  RetargetTimes times;
  RetargetOptions options;                                ///< asked for
  std::shared_ptr<const TorqueGeometry> torque_geometry;  ///< of step 3
};

/// The reference in a body of `shape`. With RetargetMethod::Naive the points move with their bones and lengths scale
/// with the path at the zero posture: what the others are compared with. A stop request is answered within 0.2 s.
/// @throws InputError for a shape that the deformation cannot represent.
Retargeted retarget(const RetargetReference& reference, const ShapeParameters& shape,
                    const RetargetOptions& options = {}, const Job& job = {});

/// The same result, to the last bit, sooner: units that feel nothing of what has changed in the shape since
/// `previous` (of the same reference) are taken over from it. For a slider that is being dragged.
Retargeted retarget(const RetargetReference& reference, const ShapeParameters& shape, const RetargetOptions& options,
                    const Job& job, const Retargeted& previous);

}  // namespace sinew
