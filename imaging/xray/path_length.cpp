#include "imaging/xray/path_length.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.h"
#include "core/parallel_rows.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

/// A ray in the view frame: p = origin + s * slope with slope.z = 1, so that s is a distance along z.
struct DepthRay {
  Vector3d origin, slope;
};
DepthRay rayThrough(const ConeBeam&, const Vector3d& p_C) {
  return {Vector3d::Zero(), p_C / p_C.z()};
}
DepthRay rayThrough(const SlotScan& s, const Vector3d& p_C) {
  return {{0, p_C.y(), -s.source_to_isocenter_m}, {p_C.x() / (s.source_to_isocenter_m + p_C.z()), 0, 1}};
}
DepthRay rayThrough(const Orthographic&, const Vector3d& p_C) {
  return {{p_C.x(), p_C.y(), 0}, Vector3d::UnitZ()};
}

constexpr std::int64_t kLattice = 1024;  ///< positions a pixel

void requireInBeam(const std::optional<Eigen::Vector2d>& uv_px) {
  require(uv_px.has_value(), "a body in the beam must lie in front of the source");
}

/// A vertex as the rasteriser sees it.
struct ImagePoint {
  std::int64_t u = 0, v = 0;  ///< lattice units
  Vector3d p_C;
  DepthRay ray;
  double depth = 0;  ///< parameter of `ray` at p_C
};

/// Depths are counted from the first vertex: over a closed surface the start cancels, and the sums stay small.
std::vector<ImagePoint> imagePoints(const TriangleMesh& mesh_W, const View& view) {
  std::vector<ImagePoint> points;
  double start = 0;
  points.reserve(mesh_W.vertices.size());
  for (const auto& p_W : mesh_W.vertices) {
    const auto uv = project(view, p_W);
    requireInBeam(uv);
    ImagePoint point;
    point.u = std::llround(uv->x() * double(kLattice));
    point.v = std::llround(uv->y() * double(kLattice));
    point.p_C = view.R_CW * p_W + view.p_CW;
    point.ray = std::visit([&](const auto& p) { return rayThrough(p, point.p_C); }, view.projection);
    if (points.empty()) start = point.p_C.z() - point.ray.origin.z();
    point.ray.origin += start * point.ray.slope;
    point.depth = point.p_C.z() - point.ray.origin.z();
    points.push_back(point);
  }
  return points;
}

/// Linear function over the lattice that is >= 0 on the inner side of the edge a -> b. A pixel on the edge itself
/// belongs to the side on which it would lie if moved by (+e, +e^2): every pixel then has exactly one side.
struct Edge {
  Edge(const ImagePoint& a, const ImagePoint& b)
      : du{b.u - a.u},
        dv{b.v - a.v},
        offset{dv * a.u - du * a.v},
        smallest_inside{dv < 0 || (dv == 0 && du > 0) ? 0 : 1} {}
  std::int64_t du, dv, offset;
  std::int64_t smallest_inside;  ///< 0 if the pixels on the edge belong to this triangle
  /// Barycentric weight of the corner opposite, unscaled.
  std::int64_t at(std::int64_t u, std::int64_t v) const { return du * v - dv * u + offset; }
};

std::int64_t ceilDivide(std::int64_t a) {
  return a >= 0 ? (a + kLattice - 1) / kLattice : -(-a / kLattice);
}
std::int64_t floorDivide(std::int64_t a) {
  return a >= 0 ? a / kLattice : -((-a + kLattice - 1) / kLattice);
}

/// Adds weight * (distance along z to the triangle) to the pixels it covers, positive where rays leave.
void addTriangle(const ImagePoint* a, const ImagePoint* b, const ImagePoint* c, double weight, int width,
                 RowRange rows, float* field) {
  std::int64_t area = (b->u - a->u) * (c->v - a->v) - (b->v - a->v) * (c->u - a->u);
  if (area == 0) return;
  if (area < 0) {  // faces the source: rays enter
    std::swap(b, c);
    weight = -weight;
    area = -area;
  }
  const auto [u_low, u_high] = std::minmax({a->u, b->u, c->u});
  const auto [v_low, v_high] = std::minmax({a->v, b->v, c->v});
  const std::int64_t first_u = std::max<std::int64_t>(ceilDivide(u_low), 0);
  const std::int64_t last_u = std::min<std::int64_t>(floorDivide(u_high), width - 1);
  const std::int64_t first_v = std::max<std::int64_t>(ceilDivide(v_low), rows.begin);
  const std::int64_t last_v = std::min<std::int64_t>(floorDivide(v_high), rows.end - 1);
  if (first_u > last_u || first_v > last_v) return;

  // Distance to the plane n (p - p_a) = 0 along origin + s slope: s = n (p_a - origin) / n slope, both affine in (u,
  // v).
  const Vector3d n = (b->p_C - a->p_C).cross(c->p_C - a->p_C);
  const ImagePoint* corners[3] = {a, b, c};
  double numerator[3], denominator[3];
  for (int i = 0; i < 3; ++i) {
    numerator[i] = n.dot(a->p_C - corners[i]->ray.origin);
    denominator[i] = n.dot(corners[i]->ray.slope);
  }
  const auto [nearest, farthest] = std::minmax({a->depth, b->depth, c->depth});
  const Edge opposite[3] = {{*b, *c}, {*c, *a}, {*a, *b}};
  for (std::int64_t v = first_v; v <= last_v; ++v) {
    float* row = field + v * width;
    for (std::int64_t u = first_u; u <= last_u; ++u) {
      double top = 0, bottom = 0;
      bool inside = true;
      for (int i = 0; i < 3 && inside; ++i) {
        const std::int64_t e = opposite[i].at(u * kLattice, v * kLattice);
        inside = e >= opposite[i].smallest_inside;
        top += double(e) * numerator[i];
        bottom += double(e) * denominator[i];
      }
      if (!inside) continue;
      const double depth = std::clamp(top / bottom, nearest, farthest);  // a triangle seen edge-on has no other bound
      row[u] += float(weight * depth);
    }
  }
}

void addBall(const XrayBall& ball, const View& view, RowRange rows, float* field) {
  const auto center = project(view, ball.center_W);
  // Half width of the outline: from neighbours on the sphere across the ray, with room for perspective.
  const Vector3d x_W = view.R_CW.row(0), y_W = view.R_CW.row(1);
  double reach_px = 0;
  for (const Vector3d& across : {x_W, y_W})
    for (const double side : {-1.0, 1.0})
      if (const auto rim = project(view, Vector3d{ball.center_W + side * ball.radius_m * across}))
        reach_px = std::max(reach_px, (*rim - *center).norm());
  reach_px = 1.1 * reach_px + 2;
  const int first_v = std::max(int(std::floor(center->y() - reach_px)), rows.begin);
  const int last_v = std::min(int(std::ceil(center->y() + reach_px)), rows.end - 1);
  const int first_u = std::max(int(std::floor(center->x() - reach_px)), 0);
  const int last_u = std::min(int(std::ceil(center->x() + reach_px)), view.width_px - 1);
  for (int v = first_v; v <= last_v; ++v)
    for (int u = first_u; u <= last_u; ++u) {
      const Ray ray = backProject(view, {u, v});
      const double miss2 = (ball.center_W - ray.origin_W).cross(ray.direction_W).squaredNorm();
      const double half_chord2 = ball.radius_m * ball.radius_m - miss2;
      if (half_chord2 > 0)
        field[std::ptrdiff_t(v) * view.width_px + u] += float(2 * std::sqrt(half_chord2) * ball.contrast_per_m);
    }
}

/// Along a ray at an angle to z the path is longer than the distance along z.
void applyObliquity(const View& view, RowRange rows, float* field) {
  const Vector3d z_W = view.R_CW.row(2);
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < view.width_px; ++u) {
      float& value = field[std::ptrdiff_t(v) * view.width_px + u];
      if (value != 0) value = float(value / z_W.dot(backProject(view, {u, v}).direction_W));
    }
}

}  // namespace

PixelField attenuationField(const std::vector<XrayVolume>& volumes, const std::vector<XrayBall>& balls,
                            const View& view, const Job& job) {
  PixelField field(std::size_t(view.width_px) * std::size_t(view.height_px), 0.0F);
  const double hand = view.R_CW.determinant() < 0 ? -1 : 1;  // a mirrored film turns every outline round
  for (const auto& volume : volumes) {
    if (job.cancelled()) return {};
    const auto points = imagePoints(volume.mesh_W, view);
    forEachRowBand(view.height_px, [&](RowRange rows) {
      for (const auto& [a, b, c] : volume.mesh_W.triangles)
        addTriangle(&points[a], &points[b], &points[c], hand * volume.contrast_per_m, view.width_px, rows,
                    field.data());
    });
  }
  for (const auto& ball : balls) requireInBeam(project(view, ball.center_W));
  forEachRowBand(view.height_px, [&](RowRange rows) {
    applyObliquity(view, rows, field.data());
    for (const auto& ball : balls) addBall(ball, view, rows, field.data());
  });
  return job.cancelled() ? PixelField{} : field;
}

}  // namespace sinew
