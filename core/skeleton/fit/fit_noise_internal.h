#pragma once
#include <Eigen/Core>
#include <span>

#include "core/skeleton/fit/fit_skeleton.h"

namespace sinew {

/// Covariance [px^2] of the errors of all sightings of one landmark (two rows a sighting), by its causes, each at
/// scale 1: the pick itself, independent in every view; the published error of definition, and one of 1 m in every
/// direction, both carried into the views that share them.
struct LandmarkNoise {
  Eigen::MatrixXd pick, definition, blur;
  Eigen::MatrixXd at(const PickScale& scale) const;
};

/// A landmark at the solution: residuals [px] of its sightings and their derivative by the unknowns.
struct LinearizedLandmark {
  Eigen::VectorXd residual_px;
  Eigen::MatrixXd jacobian_px;
  LandmarkNoise noise;
};

/// Most probable scales of the errors (restricted maximum likelihood: the freedom that the unknowns took is accounted
/// for; Patterson & Thompson 1971), with priors worth a few landmarks at the stated scales so that a handful of picks
/// stays with the published figures. `weights`: of the prior of every unknown; `x`: the unknowns.
/// `definitions`: whether there are errors of definition at all.
PickScale estimatePickScale(std::span<const LinearizedLandmark> landmarks, const Eigen::VectorXd& weights,
                            const Eigen::VectorXd& x, bool definitions);

}  // namespace sinew
