#pragma once
#include <string>

#include "core/model/model.h"

namespace sinew {

/// Passive structures as actuators without a control. MuJoCo 2.2 has no exponential spring; what it has is an
/// actuator whose force is a line in its length, cut off at a force range. Four of these are one end of a coordinate:
/// 0 until each one's own angle, then growing with the angle, in sum the exponential within kMjcfStructureError of
/// its end moment until twice that moment, and straight beyond. Names: "hip_flexion_r.max.1". About a hinge they act
/// on the clinical angle itself; about a ball joint MuJoCo has the component of the rotation vector along the
/// clinical axis instead, the same while the joint turns about that axis alone.
std::string mjcfStructures(const Model& model, const std::string& indent);

/// What these actuators do in MuJoCo, as generalised forces by clinical coordinate [N m].
Eigen::VectorXd mjcfStructureMoments_Nm(const Model& model, const Posture& posture);

inline constexpr double kMjcfStructureError = 0.025;

}  // namespace sinew
