#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>

#include "core/geometry/rigid_transform.h"

namespace sinew {

// Geometry of one radiograph: pixel <- point in space. Frames: W world [m]; C view frame [m]: x along +u, y along +v,
// z from the X-ray source towards the detector; I image [px]: origin at the centre of the top-left pixel, u right,
// v down. An image that is stored mirrored (a posterior-anterior film shown with the patient's right on the left) has
// a left-handed C: R_CW is then orthogonal with determinant -1. Sources: Hartley & Zisserman 2003, ch. 6 (pinhole);
// OpenCV's distortion model; slot scanner geometry of EOS type (fan across the slot, parallel along the scan).

/// Point source and flat detector; C has its origin in the source. Pinhole with Brown distortion.
struct ConeBeam {
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  friend bool operator==(const ConeBeam&, const ConeBeam&) = default;
};

/// Slot scanner: C has its origin in the isocentre; u is scaled to the plane z = 0 and magnified across the slot by
/// D / (D + z), v is the scan position, not magnified.
struct SlotScan {
  double source_to_isocenter_m = 0;                ///< D
  double column_spacing_m = 0, row_spacing_m = 0;  ///< of one pixel in the isocentre plane
  double u0_px = 0, v0_px = 0;                     ///< image of the isocentre
  friend bool operator==(const SlotScan&, const SlotScan&) = default;
};

/// Parallel beam along z.
struct Orthographic {
  double column_spacing_m = 0, row_spacing_m = 0;
  double u0_px = 0, v0_px = 0;
  friend bool operator==(const Orthographic&, const Orthographic&) = default;
};

struct View {
  std::variant<ConeBeam, SlotScan, Orthographic> projection;
  Eigen::Matrix3d R_CW = Eigen::Matrix3d::Identity();  ///< p_C = R_CW p_W + p_CW
  Eigen::Vector3d p_CW = Eigen::Vector3d::Zero();
  int width_px = 0, height_px = 0;
  friend bool operator==(const View&, const View&) = default;
};

struct Ray {
  Eigen::Vector3d origin_W;
  Eigen::Vector3d direction_W;  ///< unit, from the source towards the detector
};

/// Ray of the photons that reach pixel `uv_px`.
Ray backProject(const View& view, const Eigen::Vector2d& uv_px);

/// "cone_beam", "slot_scan" or "orthographic".
std::string projectionName(const View& view);

/// Image of the axis of the beam: principal point of a cone beam, image of the isocentre otherwise.
Eigen::Vector2d principalPoint_px(const View& view);

/// Pixels per millimetre across the beam at a point: the mean over both image axes. What turns a reader's error in
/// mm at the body into pixels. NaN behind the source.
double pixelsPerMillimetre(const View& view, const Eigen::Vector3d& p_W);

namespace detail {

/// `Pinhole`: a ConeBeam, or the same members as a solver's unknowns. Every residual projects through here.
template <class T, class Pinhole>
requires requires(const Pinhole& c) {
  T(c.fx_px) + T(c.k3);
}
bool project(const Pinhole& c, const Vector3<T>& p_C, Eigen::Matrix<T, 2, 1>& uv_px) {
  if (!(p_C.z() > T(1e-6))) return false;
  const T x = p_C.x() / p_C.z(), y = p_C.y() / p_C.z();
  const T r2 = x * x + y * y;
  const T radial = T(1) + r2 * (T(c.k1) + r2 * (T(c.k2) + r2 * T(c.k3)));
  const T xd = x * radial + T(2.0 * c.p1) * x * y + T(c.p2) * (r2 + T(2) * x * x);
  const T yd = y * radial + T(c.p1) * (r2 + T(2) * y * y) + T(2.0 * c.p2) * x * y;
  uv_px << T(c.fx_px) * xd + T(c.cx_px), T(c.fy_px) * yd + T(c.cy_px);
  return true;
}

template <class T>
bool project(const SlotScan& s, const Vector3<T>& p_C, Eigen::Matrix<T, 2, 1>& uv_px) {
  const T depth = T(s.source_to_isocenter_m) + p_C.z();
  if (!(depth > T(1e-6))) return false;
  uv_px << T(s.u0_px) + p_C.x() * T(s.source_to_isocenter_m) / depth / T(s.column_spacing_m),
      T(s.v0_px) + p_C.y() / T(s.row_spacing_m);
  return true;
}

template <class T>
bool project(const Orthographic& o, const Vector3<T>& p_C, Eigen::Matrix<T, 2, 1>& uv_px) {
  uv_px << T(o.u0_px) + p_C.x() / T(o.column_spacing_m), T(o.v0_px) + p_C.y() / T(o.row_spacing_m);
  return true;
}

}  // namespace detail

/// Image of a point. Returns false, and leaves `uv_px` alone, for a point behind the source.
template <class T>
bool project(const View& view, const Vector3<T>& p_W, Eigen::Matrix<T, 2, 1>& uv_px) {
  const Vector3<T> p_C = view.R_CW.cast<T>() * p_W + view.p_CW.cast<T>();
  return std::visit([&](const auto& p) { return detail::project<T>(p, p_C, uv_px); }, view.projection);
}

/// Image of a point; nullopt behind the source.
inline std::optional<Eigen::Vector2d> project(const View& view, const Eigen::Vector3d& p_W) {
  Eigen::Vector2d uv_px;
  if (!project<double>(view, p_W, uv_px)) return std::nullopt;
  return uv_px;
}

}  // namespace sinew
