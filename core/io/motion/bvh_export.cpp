#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/io/motion/bvh_poses.h"
#include "core/io/motion/bvh_roles_internal.h"

namespace sinew {

BvhMotion motionFromPostures(const Skeleton& skeleton, const std::vector<Posture>& postures, double frame_time_s) {
  constexpr double kCentimetres = 100;
  // W to the file's world: x left = -Z, y up = Y, z forward = X.
  Eigen::Matrix3d R_FW;
  R_FW << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  const auto X_rest = segmentPoses(skeleton, restOfRigs(skeleton));
  BvhMotion motion{.frame_time_s = frame_time_s};
  std::vector<int> joint_of(skeleton.segments.size(), -1), segment_of;
  int channels = 0;
  for (const Joint& j : skeleton.joints) {
    const auto role = std::ranges::find_if(
        bvhRoles(), [&](const BvhRole& r) { return skeleton.segments[j.child].name == r.segment; });
    std::string name = role->joints.front();
    if (name == "LowerBack") name = "Spine";
    if (name == "Spine3") name = "Spine1";
    BvhJoint joint{.name = name, .parent = j.parent < 0 ? -1 : joint_of[j.parent]};
    Eigen::Vector3d from = Eigen::Vector3d::Zero();
    if (j.parent >= 0) from = X_rest[j.parent].translation();
    joint.offset = kCentimetres * R_FW * (X_rest[j.child].translation() - from);
    joint.first_channel = channels;
    if (j.parent < 0) joint.channels = {BvhChannel::Xposition, BvhChannel::Yposition, BvhChannel::Zposition};
    for (const BvhChannel c : {BvhChannel::Zrotation, BvhChannel::Xrotation, BvhChannel::Yrotation})
      joint.channels.push_back(c);
    channels += static_cast<int>(joint.channels.size());
    joint_of[j.child] = static_cast<int>(motion.joints.size());
    segment_of.push_back(j.child);
    motion.joints.push_back(joint);
  }
  motion.channels.resize(channels, static_cast<Eigen::Index>(postures.size()));
  for (std::size_t f = 0; f < postures.size(); ++f) {
    const auto X_WB = segmentPoses(skeleton, postures[f]);
    std::vector<Eigen::Matrix3d> R_F;  // turn of every joint since the rest pose
    for (std::size_t j = 0; j < motion.joints.size(); ++j) {
      const int s = segment_of[j];
      R_F.push_back(R_FW * turnBetween(X_rest[s].linear(), X_WB[s].linear()) * R_FW.transpose());
      const BvhJoint& joint = motion.joints[j];
      const Eigen::Matrix3d R = joint.parent < 0 ? R_F[j] : Eigen::Matrix3d{R_F[joint.parent].transpose() * R_F[j]};
      int c = joint.first_channel;
      const Eigen::Vector3d place = kCentimetres * R_FW * X_WB[s].translation();
      if (joint.parent < 0)
        for (const double x : place) motion.channels(c++, static_cast<Eigen::Index>(f)) = x;
      // R = Rz(a) Rx(b) Ry(c)
      const double b = std::asin(std::clamp(R(2, 1), -1.0, 1.0));
      for (const double angle : {std::atan2(-R(0, 1), R(1, 1)), b, std::atan2(-R(2, 0), R(2, 2))})
        motion.channels(c++, static_cast<Eigen::Index>(f)) = angle * kDegPerRad;
    }
  }
  return motion;
}

}  // namespace sinew
