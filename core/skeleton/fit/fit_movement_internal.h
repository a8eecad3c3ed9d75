#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/skeleton/fit/fit_nuisances_internal.h"
#include "core/skeleton/fit/fit_skeleton.h"

namespace sinew {

/// A way in which legs bend, as if nothing else had moved, and what the images say of it.
struct LegBend {
  int exposure = 0;                 ///< counted as Nuisances does
  std::vector<std::string> joints;  ///< "knee_r", those that bend most
  double angle_rad = 0;             ///< of these joints
  double sigmas = 0;                ///< over what it would scatter if no joint had moved
};
/// The bend with the greatest evidence before any exposure, if there is one beyond doubt, among single joints of one
/// leg, a leg that bends at hip, knee and ankle with its foot in place, and both legs alike: the score test of the
/// hypothesis that no joint moved, from the estimate y of small changes and its covariance at the solution.
std::optional<LegBend> likeliestBend(const Skeleton& skeleton, const Nuisances& nuisances, const Eigen::VectorXd& y,
                                     const Eigen::MatrixXd& covariance);

/// How the patient moved before every further exposure, from the nuisances y and their covariance at the solution.
/// The joints of `bend` have moved.
std::vector<ExposureMovement> describeMovements(const Skeleton& skeleton, std::span<const FitView> views,
                                                const Nuisances& nuisances, const Eigen::VectorXd& y,
                                                const Eigen::MatrixXd& covariance,
                                                const std::optional<LegBend>& bend);

/// Warnings "patient_moved" and "joint_moved", worst first, in a reader's words.
void warnOfMovement(const std::vector<ExposureMovement>& movements, Warnings& warnings);

}  // namespace sinew
