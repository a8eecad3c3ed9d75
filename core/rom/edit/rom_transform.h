#pragma once
#include <optional>
#include <vector>

#include "core/posture/range_image.h"
#include "core/posture/twist_swing.h"
#include "core/rom/edit/rom_edit.h"
#include "core/rom/poses/pose_set.h"

namespace sinew {

/// The middles of the ranges, about which edits scale (phi of Ryu et al.): averages over a pose set, computed once
/// per reference. By joint; only what fits its type counts.
struct RomCentres {
  std::vector<double> angle_rad;             ///< of hinges
  std::vector<double> twist_rad;             ///< of ball joints, circular mean
  std::vector<Eigen::Vector3d> direction_J;  ///< mean direction of the shaft, unit
};
RomCentres romCentres(const Skeleton& skeleton, const PoseStream& poses);

/// T of a list of edits, and its inverse. On one ball joint: the direction is turned back by the tilt and its angle
/// to the middle of the cone divided by the factor; the twist likewise about its own middle. What T takes beyond half
/// a turn has no image: outside of the edited range, whatever the reference says. (A hinge has one at half a turn.)
class RomTransform {
 public:
  /// @throws InputError as checkRomEdits().
  RomTransform(const Skeleton& skeleton, const RomCentres& centres, const RomEdits& edits,
               const std::string& where = "range-of-motion edit");

  /// Joints that some edit changes, ascending.
  const std::vector<int>& joints() const { return joints_; }
  bool changes(int joint) const { return !steps_[joint].empty(); }

  double hinge(int joint, double angle_rad) const;
  double hingeInverse(int joint, double angle_rad) const;
  std::optional<TwistSwing> ball(int joint, const TwistSwing& orientation) const;
  /// Beyond half a turn: half a turn.
  TwistSwing ballInverse(int joint, const TwistSwing& orientation) const;

  /// T of the parts, for a grid: they do not depend on each other.
  std::optional<double> twist(int joint, double twist_rad) const;
  std::optional<Eigen::Vector3d> direction(int joint, const Eigen::Vector3d& direction_J) const;

  /// The range of an edited ball joint: that of the reference, which may be an edited one itself, at T.
  EditedRange editedRange(int joint) const;

  /// T(q); nullopt where T has no image. V~(q) = V(T(q)). One joint may be left as it is (a map moves it itself).
  std::optional<Posture> apply(const Posture& q, int except_joint = -1) const;
  /// A posture that T takes to `q`.
  Posture inverse(const Posture& q) const;
  /// The same in place; nothing else of the posture is touched.
  void invert(Eigen::Ref<Posture> q) const;

 private:
  const Skeleton* skeleton_;
  std::vector<RangeSteps> steps_;         ///< by joint, in the order of the edits
  std::vector<Eigen::Vector3d> shaft_J_;  ///< by joint
  std::vector<int> joints_;
};

}  // namespace sinew
