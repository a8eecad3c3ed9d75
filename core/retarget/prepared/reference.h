#pragma once
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "core/model/model.h"
#include "core/retarget/prepared/range_samples.h"
#include "core/retarget/prepared/routing_reference.h"
#include "core/retarget/prepared/torque_geometry.h"
#include "core/rom/poses/pose_set.h"
#include "core/skeleton/joint_motion.h"

namespace sinew {

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

}  // namespace sinew
