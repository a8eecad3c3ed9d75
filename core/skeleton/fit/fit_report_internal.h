#pragma once
#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/skeleton/fit/fit_skeleton.h"
#include "core/skeleton/shape/body_parameters_internal.h"

namespace sinew {

/// One sighting that the fit uses.
struct UsableSighting {
  std::string landmark;
  int point = 0;  ///< index into SightingList::landmarks
  int view = 0;
  Eigen::Vector2d uv_px;
  double sigma_px = 1;
  bool left_out = false;  ///< a gross error
};
struct SightingList {
  std::vector<int> landmarks;  ///< indices into skeleton.landmarks, each once
  std::vector<UsableSighting> items;
  Warnings warnings;  ///< unknown names, landmarks of driven bones, seen once
};

/// Checks and sorts what was observed. @throws InputError for a view that does not exist, numbers that are not
/// finite, sigma <= 0, or if nothing usable remains.
SightingList usableSightings(const Skeleton& reference, std::size_t view_count,
                             std::span<const LandmarkObservation> observations);

/// From fit.residuals, in the order of the list: rms_px, and warnings "picks_disagree", "outlier" (worst first) and
/// "residuals_exceed_sigma".
void describeResiduals(const SightingList& sightings, SkeletonFit& fit);

/// Entries of z whose SD stays above `ratio` of the prior's.
std::vector<bool> undeterminedUnknowns(const BodyParameters& body, const Eigen::MatrixXd& covariance, double ratio);
/// The same by name: shape parameters, and coordinates (variance about their axes).
std::vector<std::string> namesOf(const Skeleton& reference, const BodyParameters& body,
                                 const Eigen::MatrixXd& covariance, double ratio);

/// Warns "parameter_at_bound": there the interval is too narrow and the shape implausible.
void warnOfBounds(const BodyParameters& body, const Eigen::VectorXd& z, Warnings& warnings);

}  // namespace sinew
