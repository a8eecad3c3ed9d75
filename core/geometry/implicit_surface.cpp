#include "core/geometry/implicit_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"

namespace sinew {
namespace {

/// Polynomial smooth minimum (Quilez 2013): differs from min(a, b) only where |a - b| < k.
double smoothMin(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0);
  return std::min(a, b) - (k > 0 ? h * h / (4 * k) : 0.0);
}

}  // namespace

double Primitive::boundDistance(const Eigen::Vector3d& p) const {
  return (lower_ - p).cwiseMax(p - upper_).cwiseMax(0.0).norm();
}

void Primitive::include(const Eigen::Vector3d& p, double reach) {
  lower_ = lower_.cwiseMin((p.array() - reach).matrix());
  upper_ = upper_.cwiseMax((p.array() + reach).matrix());
}

ImplicitSurface::ImplicitSurface(std::vector<SurfacePart> parts, bool symmetric)
    : parts_{std::move(parts)}, symmetric_{symmetric} {
  require(!parts_.empty() && parts_.front().join == JoinKind::Add, "the first part of a surface is added");
  lower_ = parts_.front().primitive->lower();
  upper_ = parts_.front().primitive->upper();
  for (const auto& part : parts_) {
    if (part.join != JoinKind::Add) continue;
    lower_ = lower_.cwiseMin((part.primitive->lower().array() - part.blend_m / 4).matrix());
    upper_ = upper_.cwiseMax((part.primitive->upper().array() + part.blend_m / 4).matrix());
  }
  if (symmetric_) {
    upper_.z() = std::max(upper_.z(), -lower_.z());
    lower_.z() = -upper_.z();
  }
}

double ImplicitSurface::distance(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d q = symmetric_ ? Eigen::Vector3d{p.x(), p.y(), std::abs(p.z())} : p;
  double d = 1e9;
  for (const auto& [join, k, primitive] : parts_) {
    const double bound = primitive->boundDistance(q);
    switch (join) {  // a part too far to change the value is not evaluated
      case JoinKind::Add:
        if (bound < d + k) d = smoothMin(d, primitive->distance(q), k);
        break;
      case JoinKind::Cut:
        if (bound < k - d) d = -smoothMin(-d, primitive->distance(q), k);
        break;
      case JoinKind::Keep:
        d = -smoothMin(-d, -primitive->distance(q), k);
        break;
    }
  }
  return d;
}

Eigen::Vector3d ImplicitSurface::gradient(const Eigen::Vector3d& p) const {
  constexpr double kStep_m = 1e-5;
  Eigen::Vector3d g;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(i);
    g[i] = (distance(p + step) - distance(p - step)) / (2 * kStep_m);
  }
  return g;
}

Eigen::Vector3d ImplicitSurface::nearestSurfacePoint(const Eigen::Vector3d& p) const {
  Eigen::Vector3d x = p;
  for (int i = 0; i < 30; ++i) {
    const double d = distance(x);
    if (std::abs(d) < 1e-6) break;
    const Eigen::Vector3d g = gradient(x);
    x -= g * (d / std::max(g.squaredNorm(), 0.25));  // never more than four times the distance: ridges stay stable
  }
  return x;
}

}  // namespace sinew
