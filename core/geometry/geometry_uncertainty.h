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

/// Errors of one view: scale, shift along u and v [px], distance [m], turn about x, y, z of C [rad], k1.
inline constexpr int kViewErrors = 8;
template <class T>
using ViewErrors = Eigen::Matrix<T, kViewErrors, 1>;
enum ViewError { kScaleError, kShiftError, kDistanceError = 3, kTurnError, kDistortionError = 7 };

/// Their standard deviations; common_distance_m is not among them.
ViewErrors<double> standardDeviations(const GeometryUncertainty& uncertainty);

/// Image of a point in a view that has these errors; it turns about `pivot_W`. With errors of 0 the same as
/// project(). Returns false, and leaves `uv_px` alone, for a point behind the source.
template <class T>
bool projectWithErrors(const View& view, const ViewErrors<T>& errors, const Eigen::Vector3d& pivot_W,
                       const Vector3<T>& p_W, Eigen::Matrix<T, 2, 1>& uv_px) {
  const Vector3<T> arm_C = view.R_CW.cast<T>() * (p_W - pivot_W.cast<T>());
  Vector3<T> p_C = (view.R_CW * pivot_W + view.p_CW).cast<T>() +
                   rotationFromVector<T>(Vector3<T>{errors.template segment<3>(kTurnError)}) * arm_C;
  p_C.z() += errors[kDistanceError];
  if (!std::visit([&](const auto& p) { return detail::project<T>(p, p_C, uv_px); }, view.projection)) return false;
  const Eigen::Vector2d middle_px = principalPoint_px(view);
  if (const auto* cone = std::get_if<ConeBeam>(&view.projection)) {
    const T x = p_C.x() / p_C.z(), y = p_C.y() / p_C.z(), bent = errors[kDistortionError] * (x * x + y * y);
    uv_px.x() += T(cone->fx_px) * bent * x;  // k1 enters the projection linearly
    uv_px.y() += T(cone->fy_px) * bent * y;
  }
  uv_px += errors[kScaleError] * (uv_px - middle_px.cast<T>()) + errors.template segment<2>(kShiftError);
  return true;
}

}  // namespace sinew
