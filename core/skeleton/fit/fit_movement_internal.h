#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/skeleton/fit/fit_nuisances_internal.h"
#include "core/skeleton/fit/fit_skeleton.h"

namespace sinew {

/// How the patient moved before every further exposure, from the nuisances y and their covariance at the solution.
std::vector<ExposureMovement> describeMovements(const Skeleton& skeleton, std::span<const FitView> views,
                                                const Nuisances& nuisances, const Eigen::VectorXd& y,
                                                const Eigen::MatrixXd& covariance);

/// Warnings "patient_moved" and "joint_moved", worst first, in a reader's words.
void warnOfMovement(const std::vector<ExposureMovement>& movements, Warnings& warnings);

}  // namespace sinew
