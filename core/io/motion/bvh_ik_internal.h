#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/io/motion/bvh_poses.h"

namespace sinew {

/// What the solver aims at in one frame.
struct BvhTargets {
  struct Turn {
    int segment;
    double weight;
    Eigen::Matrix3d R_WB;
  };
  struct Direction {
    int from, to;
    Eigen::Vector3d direction_W;
  };
  std::vector<Turn> turns;
  std::vector<Direction> directions;
  Eigen::Vector3d p_WPelvis = Eigen::Vector3d::Zero();
};

/// Gauss-Newton over all coordinates, from where the turns of the joints alone lead; a step that makes it worse is
/// taken back and damped. A weak pull to the start decides what nothing else does.
class BvhInverseKinematics {
 public:
  /// Both outlive this.
  BvhInverseKinematics(const Skeleton& skeleton, const MotionImportOptions& options)
      : skeleton_{skeleton}, options_{options} {}

  /// Joints without a target stay as in `otherwise`.
  Posture solve(const Posture& otherwise, const BvhTargets& targets) const;

 private:
  Posture turned(const Posture& otherwise, const BvhTargets& targets) const;
  double costAt(const Posture& q, const Posture& start, const BvhTargets& targets) const;
  void accumulate(const Posture& q, const BvhTargets& targets, Eigen::MatrixXd& H, Eigen::VectorXd& g) const;
  void keepInside(Posture& q) const;

  const Skeleton& skeleton_;
  const MotionImportOptions& options_;
};

}  // namespace sinew
