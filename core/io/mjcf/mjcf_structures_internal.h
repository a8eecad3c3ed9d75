#pragma once
#include <string>

#include "core/model/model.h"

namespace sinew {

/// Whether MuJoCo gets a hinge for every coordinate of the joint, named as the coordinate: revolute joints, wrists,
/// and ball joints whose middle angle stays short of 90 deg for an athlete too, where a sequence of hinges would
/// lock. The shoulders stay balls.
bool mjcfHasHinges(const Skeleton& skeleton, int joint);

/// Passive structures as actuators without a control. MuJoCo 2.2 has no exponential spring; what it has is an
/// actuator whose force is a line in its length, cut off at a force range. Four of these are one end of a coordinate:
/// 0 until each one's own angle, then growing with the angle, in sum the exponential within kMjcfStructureError of
/// its end moment until twice that moment, and straight beyond. Names: "hip_flexion_r.max.1". About a hinge they act
/// on the clinical angle itself; about a ball MuJoCo has the component of the rotation vector along the
/// clinical axis instead, the same while the joint turns about that axis alone.
std::string mjcfStructures(const Model& model, const std::string& indent);

/// What these actuators do in MuJoCo at clinical coordinates, as generalised forces conjugate to their rates [N m].
Eigen::VectorXd mjcfStructureMoments_Nm(const Model& model, const Eigen::VectorXd& clinical);

inline constexpr double kMjcfStructureError = 0.025;

}  // namespace sinew
