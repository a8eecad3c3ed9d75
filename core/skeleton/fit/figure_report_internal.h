#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/skeleton/fit/fit_skeleton.h"
#include "core/skeleton/fit/triangulated_figures_internal.h"
#include "core/skeleton/shape/body_parameters_internal.h"

namespace sinew {

/// What is known at the solution of a fit.
struct FitEvidence {
  const Skeleton& reference;
  const BodyParameters& body;
  Eigen::VectorXd z;
  Eigen::MatrixXd covariance;        ///< of z, priors included
  std::vector<LandmarkPicks> picks;  ///< that the fit has used
  ImageOfPoint image;
  Eigen::MatrixXd nuisance_covariance;  ///< of what disturbs the views
  std::vector<std::string> offered;     ///< landmarks that could still be picked
  int view_count = 2;
};

/// Fills fit.figures, fit.outside, fit.advice and their warnings. Every figure is computed twice, from the fitted
/// skeleton and from the picks alone. The fitted one is taken, unless
/// - a bone that it depends on is outside the model, or
/// - the two differ by more than three standard deviations of their difference. Both come from the same picks and the
///   fitted one is the narrower, so that SD is sqrt(SD_picks^2 - SD_fitted^2) (Hausman 1978).
/// A figure is determined if its interval is within figureLimits() and the images have taken away at least half of
/// the prior's variance. Figures of a bone outside the model that the picks do not give are not determined.
void judgeFigures(const FitEvidence& evidence, SkeletonFit& fit);

/// Derivative of every figure with respect to the entries of z, and its value.
struct FittedFigures {
  std::vector<double> value;
  Eigen::MatrixXd by_z;  ///< figures x z
};
FittedFigures fittedFigures(const FitEvidence& evidence);

/// Landmarks whose picks would bring a figure below its limit: the one that takes away most of its variance, then the
/// next with that one known, and so on, by the covariance at hand.
/// @param figure place in figureList(). @param limit SD that is to be reached.
FigureAdvice adviceFor(const FitEvidence& evidence, const FittedFigures& figures, std::size_t figure,
                       double limit_sd);

}  // namespace sinew
