#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/geometry/implicit_surface.h"

namespace sinew {
namespace {

/// First-order distance to the ellipsoid with these radii.
double ellipsoidDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& radii) {
  const Eigen::Vector3d a = p.cwiseQuotient(radii);
  const double k0 = a.norm(), k1 = a.cwiseQuotient(radii).norm();
  return k1 < 1e-12 ? -radii.minCoeff() : k0 * (k0 - 1) / k1;
}

class Ellipsoid : public Primitive {
 public:
  Ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii, const Eigen::Matrix3d& axes)
      : center_{center}, radii_{radii}, axes_{axes} {
    require(radii.minCoeff() > 0, "radii of an ellipsoid are positive");
    const Eigen::Vector3d reach = (axes * radii.asDiagonal()).rowwise().norm();
    lower_ = center - reach;
    upper_ = center + reach;
  }
  double distance(const Eigen::Vector3d& p) const override {
    return ellipsoidDistance(axes_.transpose() * (p - center_), radii_);
  }

 private:
  Eigen::Vector3d center_, radii_;
  Eigen::Matrix3d axes_;
};

class Box : public Primitive {
 public:
  Box(const Eigen::Vector3d& center, const Eigen::Vector3d& half, const Eigen::Matrix3d& axes, double rounding)
      : center_{center}, core_{half.array() - rounding}, axes_{axes}, rounding_{rounding} {
    require(core_.minCoeff() >= 0, "a box is at least as large as its rounding");
    const Eigen::Vector3d reach = (axes * half.asDiagonal()).cwiseAbs().rowwise().sum();
    lower_ = center - reach;
    upper_ = center + reach;
  }
  double distance(const Eigen::Vector3d& p) const override {
    const Eigen::Vector3d q = (axes_.transpose() * (p - center_)).cwiseAbs() - core_;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - rounding_;
  }

 private:
  Eigen::Vector3d center_, core_;
  Eigen::Matrix3d axes_;
  double rounding_;
};

class Drum : public Primitive {
 public:
  Drum(const Eigen::Vector3d& center, const Eigen::Vector3d& half, const Eigen::Matrix3d& axes, double rounding,
       double waist)
      : center_{center}, core_{half.array() - rounding}, axes_{axes}, rounding_{rounding}, waist_{waist} {
    require(core_.minCoeff() > 0, "a drum is larger than its rounding");
    const Eigen::Vector3d reach = (axes * half.asDiagonal()).cwiseAbs().rowwise().sum();
    lower_ = center - reach;
    upper_ = center + reach;
  }
  double distance(const Eigen::Vector3d& p) const override {
    const Eigen::Vector3d q = axes_.transpose() * (p - center_);
    const double t = std::min(std::abs(q.y()) / core_.y(), 1.0);
    const double shrink = 1 - waist_ * (1 - t * t);
    const Eigen::Vector3d radii{core_.x() * shrink, 1.0, core_.z() * shrink};
    const double side = ellipsoidDistance({q.x(), 0, q.z()}, radii);
    const double end = std::abs(q.y()) - core_.y();
    return std::min(std::max(side, end), 0.0) + std::hypot(std::max(side, 0.0), std::max(end, 0.0)) - rounding_;
  }

 private:
  Eigen::Vector3d center_, core_;
  Eigen::Matrix3d axes_;
  double rounding_, waist_;
};

/// Catmull-Rom value between b and c; ends repeat their neighbour.
template <class V>
V catmullRom(const V& a, const V& b, const V& c, const V& d, double t) {
  return 0.5 *
         (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) + t * t * t * (3.0 * (b - c) + d - a));
}

/// Samples a Catmull-Rom spline through `knots`, `steps` to a span.
template <class V>
std::vector<V> splineThrough(const std::vector<V>& knots, int steps) {
  std::vector<V> samples;
  const int n = static_cast<int>(knots.size());
  const auto at = [&](int i) -> V {  // ends: mirrored neighbour, so that the spline leaves straight
    if (i < 0) return V(2.0 * knots[0] - knots[1]);
    if (i >= n) return V(2.0 * knots[n - 1] - knots[n - 2]);
    return knots[i];
  };
  for (int i = 0; i + 1 < n; ++i)
    for (int s = 0; s < steps; ++s)
      samples.push_back(catmullRom<V>(at(i - 1), at(i), at(i + 1), at(i + 2), double(s) / steps));
  samples.push_back(knots.back());
  return samples;
}

constexpr double kThinnest_m = 2e-4;  // splines may swing below zero where radii taper off

class Tube : public Primitive {
 public:
  explicit Tube(const std::vector<TubeStation>& stations) {
    require(stations.size() >= 2, "a tube has at least two stations");
    using Knot = Eigen::Matrix<double, 8, 1>;  // center, u, two radii
    std::vector<Knot> knots;
    for (const auto& s : stations) {
      Knot k;
      k << s.center, s.u.normalized(), s.u_radius_m, s.v_radius_m;
      knots.push_back(k);
    }
    const auto samples = splineThrough(knots, stations.size() == 2 ? 1 : 5);
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) addSegment(samples[i], samples[i + 1]);
  }
  double distance(const Eigen::Vector3d& p) const override {
    double best = 1e9;
    for (const Segment& s : segments_)
      if ((p - s.middle).norm() - s.reach < best) best = std::min(best, segmentDistance(s, p));
    return best;
  }

 private:
  struct Segment {
    Eigen::Vector3d start, along, middle;  ///< along: unit
    double length, reach;
    Eigen::Vector3d u0, u1;
    double a0, a1, b0, b1;
  };
  template <class Knot>
  void addSegment(const Knot& k0, const Knot& k1) {
    Segment s;
    s.start = k0.template head<3>();
    const Eigen::Vector3d end = k1.template head<3>(), step = end - s.start;
    s.length = step.norm();
    if (s.length < 1e-9) return;
    s.along = step / s.length;
    s.middle = (s.start + end) / 2;
    s.u0 = k0.template segment<3>(3);
    s.u1 = k1.template segment<3>(3);
    s.a0 = std::max(k0[6], kThinnest_m);
    s.b0 = std::max(k0[7], kThinnest_m);
    s.a1 = std::max(k1[6], kThinnest_m);
    s.b1 = std::max(k1[7], kThinnest_m);
    const double r = std::max({s.a0, s.b0, s.a1, s.b1});
    s.reach = s.length / 2 + r;
    include(s.start, r);
    include(end, r);
    segments_.push_back(s);
  }
  static double segmentDistance(const Segment& s, const Eigen::Vector3d& p) {
    const double axial = (p - s.start).dot(s.along), t = std::clamp(axial / s.length, 0.0, 1.0);
    const Eigen::Vector3d offset = p - s.start - t * s.length * s.along;
    Eigen::Vector3d u = (1 - t) * s.u0 + t * s.u1;
    u -= u.dot(s.along) * s.along;
    u.normalize();
    const Eigen::Vector3d v = s.along.cross(u);
    const double a = (1 - t) * s.a0 + t * s.a1, b = (1 - t) * s.b0 + t * s.b1;
    return ellipsoidDistance({offset.dot(u), offset.dot(v), offset.dot(s.along)}, {a, b, std::min(a, b)});
  }
  std::vector<Segment> segments_;
};

/// Nearest point of triangle abc to p as weights of its corners (Ericson, Real-Time Collision Detection 2005, 5.1.5).
Eigen::Vector3d nearestWeights(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

class Sheet : public Primitive {
 public:
  explicit Sheet(const std::vector<std::vector<SheetPoint>>& rows) {
    constexpr int kSteps = 4;
    require(rows.size() >= 2 && rows.front().size() >= 2, "a sheet has at least 2 x 2 points");
    using Knot = Eigen::Vector4d;
    std::vector<std::vector<Knot>> fine_rows;
    for (const auto& row : rows) {
      require(row.size() == rows.front().size(), "rows of a sheet have the same length");
      std::vector<Knot> knots;
      for (const auto& s : row) knots.emplace_back(s.p.x(), s.p.y(), s.p.z(), s.half_thickness_m);
      fine_rows.push_back(splineThrough(knots, kSteps));
    }
    const std::size_t columns = fine_rows.front().size();
    std::vector<std::vector<Knot>> fine(columns);  // by column
    for (std::size_t c = 0; c < columns; ++c) {
      std::vector<Knot> knots;
      for (const auto& row : fine_rows) knots.push_back(row[c]);
      fine[c] = splineThrough(knots, kSteps);
    }
    for (std::size_t c = 0; c + 1 < columns; ++c)
      for (std::size_t r = 0; r + 1 < fine[c].size(); ++r) {
        addTriangle(fine[c][r], fine[c + 1][r], fine[c + 1][r + 1]);
        addTriangle(fine[c][r], fine[c + 1][r + 1], fine[c][r + 1]);
      }
  }
  double distance(const Eigen::Vector3d& p) const override {
    double best = 1e9;
    for (const Facet& f : facets_) {
      if ((p - f.middle).norm() - f.reach >= best) continue;
      const Eigen::Vector3d w = nearestWeights(p, f.p[0], f.p[1], f.p[2]);
      best = std::min(best, (p - w[0] * f.p[0] - w[1] * f.p[1] - w[2] * f.p[2]).norm() - w.dot(f.half));
    }
    return best;
  }

 private:
  struct Facet {
    std::array<Eigen::Vector3d, 3> p;
    Eigen::Vector3d half, middle;
    double reach;
  };
  void addTriangle(const Eigen::Vector4d& a, const Eigen::Vector4d& b, const Eigen::Vector4d& c) {
    Facet f;
    f.p = {a.head<3>(), b.head<3>(), c.head<3>()};
    f.half = Eigen::Vector3d{a[3], b[3], c[3]}.cwiseMax(kThinnest_m);
    f.middle = (f.p[0] + f.p[1] + f.p[2]) / 3;
    f.reach = 0;
    for (int i = 0; i < 3; ++i) {
      f.reach = std::max(f.reach, (f.p[i] - f.middle).norm());
      include(f.p[i], f.half.maxCoeff());
    }
    f.reach += f.half.maxCoeff();
    facets_.push_back(f);
  }
  std::vector<Facet> facets_;
};

}  // namespace

Eigen::Matrix3d axesFrom(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  Eigen::Matrix3d axes;
  axes.col(0) = u.normalized();
  axes.col(1) = (v - v.dot(axes.col(0)) * axes.col(0)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  require(std::abs(axes.determinant() - 1) < 1e-6, "two axes are not parallel");
  return axes;
}

std::unique_ptr<Primitive> makeSphere(const Eigen::Vector3d& center, double radius_m) {
  return makeEllipsoid(center, Eigen::Vector3d::Constant(radius_m), Eigen::Matrix3d::Identity());
}
std::unique_ptr<Primitive> makeEllipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii_m,
                                         const Eigen::Matrix3d& axes) {
  return std::make_unique<Ellipsoid>(center, radii_m, axes);
}
std::unique_ptr<Primitive> makeBox(const Eigen::Vector3d& center, const Eigen::Vector3d& half_m,
                                   const Eigen::Matrix3d& axes, double rounding_m) {
  return std::make_unique<Box>(center, half_m, axes, rounding_m);
}
std::unique_ptr<Primitive> makeDrum(const Eigen::Vector3d& center, const Eigen::Vector3d& half_m,
                                    const Eigen::Matrix3d& axes, double rounding_m, double waist) {
  return std::make_unique<Drum>(center, half_m, axes, rounding_m, waist);
}
std::unique_ptr<Primitive> makeTube(const std::vector<TubeStation>& stations) {
  return std::make_unique<Tube>(stations);
}
std::unique_ptr<Primitive> makeSheet(const std::vector<std::vector<SheetPoint>>& rows) {
  return std::make_unique<Sheet>(rows);
}

}  // namespace sinew
