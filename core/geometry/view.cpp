#include "core/geometry/view.h"

#include <limits>

namespace sinew {
namespace {

/// Fixed-point inverse of the distortion; converges for the mild distortions of X-ray detectors.
Eigen::Vector2d undistorted(const ConeBeam& c, const Eigen::Vector2d& distorted) {
  Eigen::Vector2d xy = distorted;
  for (int i = 0; i < 50; ++i) {
    const double x = xy.x(), y = xy.y(), r2 = xy.squaredNorm();
    const double radial = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
    const Eigen::Vector2d tangential{2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
                                     c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y};
    const Eigen::Vector2d next = (distorted - tangential) / radial;
    if ((next - xy).norm() < 1e-14) return next;
    xy = next;
  }
  return xy;
}

/// The ray in the view frame C.
Ray rayInView(const ConeBeam& c, const Eigen::Vector2d& uv) {
  const Eigen::Vector2d xy = undistorted(c, {(uv.x() - c.cx_px) / c.fx_px, (uv.y() - c.cy_px) / c.fy_px});
  return {Eigen::Vector3d::Zero(), xy.homogeneous().normalized()};
}

Ray rayInView(const SlotScan& s, const Eigen::Vector2d& uv) {
  const double x_m = (uv.x() - s.u0_px) * s.column_spacing_m;
  const Eigen::Vector3d source{0, (uv.y() - s.v0_px) * s.row_spacing_m, -s.source_to_isocenter_m};
  return {source, Eigen::Vector3d{x_m, 0, s.source_to_isocenter_m}.normalized()};
}

Ray rayInView(const Orthographic& o, const Eigen::Vector2d& uv) {
  return {{(uv.x() - o.u0_px) * o.column_spacing_m, (uv.y() - o.v0_px) * o.row_spacing_m, 0},
          Eigen::Vector3d::UnitZ()};
}

}  // namespace

Ray backProject(const View& view, const Eigen::Vector2d& uv_px) {
  const Ray ray_C = std::visit([&](const auto& p) { return rayInView(p, uv_px); }, view.projection);
  const Eigen::Matrix3d R_WC = view.R_CW.transpose();
  return {R_WC * (ray_C.origin_W - view.p_CW), R_WC * ray_C.direction_W};
}

Eigen::Vector2d principalPoint_px(const View& view) {
  if (const auto* c = std::get_if<ConeBeam>(&view.projection)) return {c->cx_px, c->cy_px};
  if (const auto* s = std::get_if<SlotScan>(&view.projection)) return {s->u0_px, s->v0_px};
  const auto& o = std::get<Orthographic>(view.projection);
  return {o.u0_px, o.v0_px};
}

double pixelsPerMillimetre(const View& view, const Eigen::Vector3d& p_W) {
  constexpr double kStep_mm = 1, kStep_m = 1e-3;
  const auto here = project(view, p_W);
  double sum = 0;
  for (const int axis : {0, 1}) {
    const Eigen::Vector3d across = view.R_CW.row(axis);
    const auto there = project(view, Eigen::Vector3d{p_W + kStep_m * across});
    if (!here || !there) return std::numeric_limits<double>::quiet_NaN();
    sum += (*there - *here).norm() / kStep_mm;
  }
  return sum / 2;
}

std::string projectionName(const View& view) {
  constexpr const char* kNames[] = {"cone_beam", "slot_scan", "orthographic"};
  return kNames[view.projection.index()];
}

}  // namespace sinew
