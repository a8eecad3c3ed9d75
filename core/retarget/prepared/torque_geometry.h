#pragma once
#include <span>
#include <vector>

#include "core/kernel/pose_table.h"
#include "core/model/model.h"
#include "core/skeleton/joint_motion.h"

namespace sinew {

/// What the torques of one body depend on, measured once: path lengths and moment arms over every motion. They do not
/// change with the ratios.
class TorqueGeometry {
 public:
  static constexpr int kSamples = 25;  ///< evenly over theta

  /// `postures`: motionPostures() of the reference; `units_of`: by motion, the units that span its coordinate.
  TorqueGeometry(const Model& model, const PoseTable& postures, const std::vector<std::vector<int>>& units_of,
                 const std::vector<JointMotion>& motions);
  /// The same, of which `unchanged` units are taken over from `previous`.
  TorqueGeometry(const Model& model, const PoseTable& postures, const std::vector<std::vector<int>>& units_of,
                 const std::vector<JointMotion>& motions, const TorqueGeometry& previous,
                 const std::vector<bool>& unchanged);

  struct UnitInMotion {
    int unit = -1;
    std::vector<double> length_m, arm_m;  ///< by sample; arm 0 where the unit does not turn the motion's way
  };
  const std::vector<UnitInMotion>& unitsOf(std::size_t motion) const { return units_[motion]; }
  std::size_t motionCount() const { return units_.size(); }

 private:
  std::vector<std::vector<UnitInMotion>> units_;
};

/// One of the motions that a unit takes part in, and its place in unitsOf(motion).
struct UnitPart {
  std::size_t motion, place;
};
std::vector<std::vector<UnitPart>> partsByUnit(const TorqueGeometry& geometry, std::size_t unit_count);

/// Three postures a sample of every motion: a little before, at, a little behind.
PoseTable motionPostures(const Skeleton& skeleton, const std::vector<JointMotion>& motions);

/// Torque of one unit in a motion by sample [N m]: its active force in equilibrium() times the arm.
std::vector<double> unitTorque_Nm(const MusculotendonUnit& unit, const TorqueGeometry::UnitInMotion& swept);
/// Torque of one motion by sample [N m], and where it is greatest.
std::vector<double> motionTorque_Nm(const Musculature& musculature, const TorqueGeometry& geometry,
                                    std::size_t motion);
/// theta in [0, 1] of the greatest torque, on the parabola through the samples around it; NaN if nothing turns.
double peakTheta(std::span<const double> torque_Nm);

}  // namespace sinew
