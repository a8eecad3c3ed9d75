#pragma once
#include <Eigen/Core>

#include "core/geometry/view.h"

namespace sinew {

/// How well the geometry of a view is known: standard deviations of independent Gaussian errors with mean 0. All 0:
/// the view is exact. "The body" is the middle of what is seen.
struct GeometryUncertainty {
  double scale = 0;              ///< of focal length or pixel size, relative (distance source - detector, pitch)
  double image_shift_px = 0;     ///< of the whole image, along u and along v (principal point)
  double body_distance_m = 0;    ///< of the body from the source, along the beam
  double turn_rad = 0;           ///< of the view about each of its axes through the body (angle between the views)
  double k1 = 0;                 ///< of radial distortion on x/z, y/z that the view does not state (cone beam)
  double common_distance_m = 0;  ///< of the body from the source, the same error in all views: a patient who turns on
                                 ///< the spot before one stand. Of all views the largest counts
  friend bool operator==(const GeometryUncertainty&, const GeometryUncertainty&) = default;
};

/// Errors of one view, in this order: scale, shift along u and v [px], distance [m], turn about x, y, z of C [rad],
/// k1.
///   p_C = R_CW pivot_W + p_CW + exp(turn) R_CW (p_W - pivot_W) + distance z
///   uv  = uv' + scale (uv' - principal point) + shift,   uv' the projection of p_C with k1 added to the view's
inline constexpr int kViewErrors = 8;
enum ViewError { kScaleError, kShiftError, kDistanceError = 3, kTurnError, kDistortionError = 7 };

/// Their standard deviations; common_distance_m is not among them.
Eigen::Matrix<double, kViewErrors, 1> standardDeviations(const GeometryUncertainty& uncertainty);

}  // namespace sinew
