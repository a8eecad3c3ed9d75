#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/rigid_transform.h"

namespace sinew {

// Biovision hierarchy (BVH): a skeleton of offsets and the Euler angles of its joints, frame by frame. Positions are
// in the file's own unit (CMU files: inches or centimetres).

enum class BvhChannel { Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation };

struct BvhJoint {
  std::string name;  ///< "LeftUpLeg"; of an end site that of its joint with "_end"
  int parent = -1;   ///< parents come before children; -1: a root
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::vector<BvhChannel> channels;  ///< in the order in which turns follow each other
  int first_channel = 0;
};

struct BvhMotion {
  std::vector<BvhJoint> joints;
  double frame_time_s = 0;
  Eigen::MatrixXd channels;  ///< one column a frame; rotations in degrees, as the file has them
};

/// @param where what messages call the text. @throws InputError: where, line, expected, found.
BvhMotion parseBvh(std::string_view text, const std::string& where);
BvhMotion loadBvh(const std::filesystem::path& file);
std::string bvhText(const BvhMotion& motion);

/// Pose of every joint in the file's world; frame -1 is the rest pose: no turns, root at its offset.
std::vector<RigidTransform> bvhPoses(const BvhMotion& motion, int frame);

}  // namespace sinew
