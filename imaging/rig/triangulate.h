#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"

namespace sinew {

/// How far a sighting is from the image of the point that all sightings of its name make.
struct ViewResidual {
  int view = 0;
  Eigen::Vector2d residual_px;  ///< observed minus projected
  friend bool operator==(const ViewResidual&, const ViewResidual&) = default;
};

/// A landmark L located in space.
struct TriangulatedLandmark {
  std::string name;
  Eigen::Vector3d p_WL;                 ///< world [m]
  Eigen::Matrix3d cov_W;                ///< [m^2], from the sightings' sigma
  double reprojection_rms_px;           ///< over the sightings used
  std::vector<ViewResidual> residuals;  ///< in the order of the sightings

  /// nullptr if the landmark is not seen there.
  const Eigen::Vector2d* residualIn(int view) const;
};

/// Maximum-likelihood position of the point that caused one sighting in each of two or more views: linear start
/// (midpoint of the two rays that cross at the largest angle), then Gauss-Newton on the reprojection error weighted
/// by sigma (Hartley & Zisserman 2003, sec. 12).
/// @returns nullopt if all viewing rays are closer than 5 deg to parallel: the depth is then not observable.
/// @throws InputError for fewer than two sightings, two of one view, or a view that the rig does not have.
std::optional<TriangulatedLandmark> triangulate(const BiplanarRig& rig, std::span<const Sighting> sightings);

struct Triangulation {
  std::vector<TriangulatedLandmark> points;  ///< of the names seen in two views or more, in order of appearance
  double rms_px = std::numeric_limits<double>::quiet_NaN();
  Warnings
      warnings;  ///< seen once, nearly parallel, gross mismatch (as rare as 5 sigma), a flipped y convention, ...
};

/// All landmarks of a case. Tests besides whether the vertical image axis of one or all views was flipped (another
/// y convention), and names it in a warning "flipped_y" when that explains the residuals far better; likewise for the
/// picks of two views exchanged, "swapped_views". @throws InputError for a view that the rig does not have.
Triangulation triangulateAll(const BiplanarRig& rig, std::span<const Sighting> sightings);

/// The image in view `other_view` of the ray through `uv_px` of `view`, clipped to the image: polyline [px]. A
/// straight line for pinholes without distortion, one row for slot scans.
std::vector<Eigen::Vector2d> epipolarLine(const BiplanarRig& rig, int view, const Eigen::Vector2d& uv_px,
                                          int other_view);

}  // namespace sinew
