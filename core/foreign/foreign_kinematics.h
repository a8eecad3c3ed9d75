#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/foreign/foreign_model.h"

namespace sinew {

// Where the bodies and paths of a foreign model are. A posture has one entry a coordinate [rad; m]; entries of
// coordinates that follow others are ignored and computed.

using ForeignPosture = Eigen::VectorXd;

/// Every coordinate at its default.
ForeignPosture defaultPosture(const ForeignModel& model);

/// The posture with the coordinates that follow others filled in.
ForeignPosture coupledPosture(const ForeignModel& model, ForeignPosture q);

/// Pose X_WB of every body.
std::vector<RigidTransform> bodyPoses(const ForeignModel& model, const ForeignPosture& q);

/// Path of one unit in the world, origin first: its active points and where it meets obstacles.
std::vector<Eigen::Vector3d> foreignPathPoints(const ForeignModel& model, int unit, const ForeignPosture& q);

/// Length of one unit [m], wrapped stretches included.
double foreignLength(const ForeignModel& model, int unit, const ForeignPosture& q);
/// Of all units.
Eigen::VectorXd foreignLengths(const ForeignModel& model, const ForeignPosture& q);

/// Moment arm of a unit about one coordinate [m]: -dl/dq, through every joint function, moving point and coupled
/// coordinate (automatic differentiation). 0 about a coordinate that follows another. Exact also where the path wraps
/// over a cylinder or sphere, where it is a shortest one; over an ellipsoid to first order of its deviation from
/// that.
double foreignMomentArm(const ForeignModel& model, int unit, int coordinate, const ForeignPosture& q);
/// unit x coordinate.
Eigen::MatrixXd foreignMomentArms(const ForeignModel& model, const ForeignPosture& q);

}  // namespace sinew
