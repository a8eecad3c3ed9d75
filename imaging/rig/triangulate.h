#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"

namespace sinew {

/// A landmark L located in space.
struct TriangulatedLandmark {
  std::string name;
  Eigen::Vector3d p_WL;                        ///< world [m]
  Eigen::Matrix3d cov_W;                       ///< [m^2], from the sightings' sigma
  double reprojection_rms_px;                  ///< over the sightings used
  std::array<Eigen::Vector2d, 2> residual_px;  ///< observed minus projected, per view
};

/// Maximum-likelihood position of the point that caused one sighting per view: linear start (midpoint of the rays),
/// then Gauss-Newton on the reprojection error weighted by sigma (Hartley & Zisserman 2003, sec. 12).
/// @returns nullopt if the viewing rays are closer than 5 deg to parallel: the depth is then not observable.
/// @throws InputError if not exactly two different views are given.
std::optional<TriangulatedLandmark> triangulate(const BiplanarRig& rig, std::span<const Sighting> pair);

struct Triangulation {
  std::vector<TriangulatedLandmark> points;  ///< of the names seen in both views, in order of appearance
  double rms_px = std::numeric_limits<double>::quiet_NaN();
  Warnings warnings;  ///< seen once, nearly parallel, gross mismatch (> 5 sigma), a flipped y convention, ...
};

/// All landmarks of a case. Tests besides whether the vertical image axis of one or both views was flipped (another
/// y convention), and names it in a warning "flipped_y" when that explains the residuals far better.
Triangulation triangulateAll(const BiplanarRig& rig, std::span<const Sighting> sightings);

/// The other view's image of the ray through `uv_px` of `view`, clipped to the image: polyline [px]. A straight line
/// for pinholes without distortion, one row for slot scans.
std::vector<Eigen::Vector2d> epipolarLine(const BiplanarRig& rig, int view, const Eigen::Vector2d& uv_px);

}  // namespace sinew
