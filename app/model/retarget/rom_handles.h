#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/rom/edit/rom_transform.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

// What a hand takes hold of to edit a range of motion, and what its place says about the edit. Display-free.

/// Range of a ball joint in short: a cone about a middle direction, and an interval of the twist.
struct BallRange {
  Eigen::Vector3d centre_J = -Eigen::Vector3d::UnitY();
  double cone_rad = 0;  ///< of the directions that are free: the cone with the same area on the sphere
  double twist_centre_rad = 0, twist_low_rad = 0, twist_high_rad = 0;  ///< of the valid twists
};
/// Range of a hinge.
struct HingeRange {
  double centre_rad = 0, low_rad = 0, high_rad = 0;
};

/// Of a map of the reference, about the middles that edits scale about.
BallRange ballRange(const RomMap& map, const RomCentres& centres, int joint);
/// The stops of a hinge.
HingeRange hingeRange(const Skeleton& skeleton, const RomCentres& centres, int joint);

/// The range after an edit; what earlier edits of the joint did is in `before` already.
BallRange edited(const BallRange& before, const RomEdit& edit, const Skeleton& skeleton);
HingeRange edited(const HingeRange& before, const RomEdit& edit);

/// The last edit of a joint, nullptr if there is none.
const RomEdit* findEdit(const RomEdits& edits, const std::string& joint);
/// The same, made if there is none. An edit that changes nothing is taken out by dropIdentities().
RomEdit& editOf(RomEdits& edits, const std::string& joint);
void dropIdentities(RomEdits& edits);
/// All but the last edit of this joint: what the last one starts from.
RomEdits editsBefore(const RomEdits& edits, const std::string& joint);

/// The middle of the cone is pulled to a direction (unit): sets the tilt, the shortest turn that does it.
void pullCentre(const BallRange& before, const Eigen::Vector3d& direction_J, RomEdit& edit);
/// The border of the cone is pulled there: sets the cone's factor.
void pullBorder(const BallRange& before, const Eigen::Vector3d& direction_J, const Skeleton& skeleton, RomEdit& edit);
/// Sets factor and shift of the twist, so that its interval becomes this one. `twist_sign`: core/rom/rom_edit.h.
void setTwist(const BallRange& before, double low_rad, double high_rad, int twist_sign, RomEdit& edit);
void setHinge(const HingeRange& before, double low_rad, double high_rad, RomEdit& edit);

}  // namespace sinew
