#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/model/model.h"

namespace sinew {

/// The model in DART: its skeleton through DART's public interface, driven bodies as revolute joints that follow, and
/// for every muscle an object with a list of anchors, each a list of (body, point, weight), as muscles are commonly
/// programmed on top of a physics engine (Ryu et al.: p = sum_j w_j T_j x_j, length = sum of distances).
class DartPeer {
 public:
  /// Null where DART is not linked.
  static std::unique_ptr<DartPeer> make(const Model& model);
  static std::string version();  ///< "DART 6.12.1"
  ~DartPeer();

  /// Positions of all 54 degrees of freedom at a posture; not what is to be timed.
  Eigen::VectorXd positions(const Posture& posture) const;
  /// DART computes the pose of a body when it is first asked for, ...
  void setPositions(const Eigen::VectorXd& positions);
  Eigen::Vector3d inWorld(int segment, const Eigen::Vector3d& p_B) const;
  RigidTransform X_WB(int segment) const;
  /// ... here of all bodies.
  void moveTo(const Eigen::VectorXd& positions);
  /// Lengths of some units where the bodies are now.
  void lengths(std::span<const int> units, std::vector<double>& lengths_m) const;

 private:
  struct Impl;
  explicit DartPeer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sinew
