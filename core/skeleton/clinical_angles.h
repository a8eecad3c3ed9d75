#pragma once
#include <array>
#include <map>
#include <string>

#include "core/skeleton/kinematics.h"

namespace sinew {

/// The clinical view of a posture: 50 entries in the order of Skeleton::coordinates - angles [rad] as turns about the
/// coordinates' axes in sequence (flexion, then adduction, then axial; Grood & Suntay 1983, Wu 2002), translations
/// [m]. Inverse of each other while the middle angle stays within +-90 deg.
Eigen::VectorXd clinicalFromPosture(const Skeleton& skeleton, const Posture& q);
Posture postureFromClinical(const Skeleton& skeleton, const Eigen::VectorXd& clinical);

/// The clinical angles of one ball joint (or the turns of the root) whose child is turned by R_JB.
Eigen::Vector3d clinicalAngles(const Skeleton& skeleton, const Joint& joint, const Eigen::Matrix3d& R_JB);
/// Both readings of that orientation; the first is clinicalAngles(). They differ where the middle angle goes beyond
/// 90 deg: an arm abducted by 120 reads 60, with the other two turned by 180 deg, or 120.
std::array<Eigen::Vector3d, 2> clinicalReadings(const Skeleton& skeleton, const Joint& joint,
                                                const Eigen::Matrix3d& R_JB);

/// Posture from names and degrees (translations in metres); what is not named is 0.
/// @throws InputError for an unknown name (with the nearest) or a value that is not finite.
Posture postureFromDegrees(const Skeleton& skeleton, const std::map<std::string, double>& coordinates_deg);

/// Motion of every segment with the *clinical* coordinates instead of the entries of q: what moment arms and torques
/// about clinical axes are taken with. Same shape as Kinematics::motions.
Kinematics clinicalKinematics(const Skeleton& skeleton, const Posture& q);

}  // namespace sinew
