#include "core/foreign/foreign_wrap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sinew {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;

/// Tangents from two points to a circle about the origin, and the arc between them, on the way that turns in
/// direction `turn` (+1 counterclockwise). Both points are outside.
struct CircleWay {
  double first_rad, last_rad, arc_rad;
  double first_tangent, last_tangent;  ///< lengths
};
CircleWay circleWay(const Eigen::Vector2d& s, const Eigen::Vector2d& e, double radius, int turn) {
  const double ds = s.norm(), de = e.norm();
  CircleWay way{};
  way.first_rad = std::atan2(s.y(), s.x()) + turn * std::acos(std::min(1.0, radius / ds));
  way.last_rad = std::atan2(e.y(), e.x()) - turn * std::acos(std::min(1.0, radius / de));
  way.arc_rad = std::fmod(turn * (way.last_rad - way.first_rad), kTurn_rad);
  if (way.arc_rad < 0) way.arc_rad += kTurn_rad;
  way.first_tangent = std::sqrt(std::max(0.0, ds * ds - radius * radius));
  way.last_tangent = std::sqrt(std::max(0.0, de * de - radius * radius));
  return way;
}

template <class Vector>
Vector nearestToOrigin(const Vector& s, const Vector& e) {
  const Vector along = e - s;
  const double squared = along.squaredNorm();
  return squared > 0 ? Vector{s + along * std::clamp(-s.dot(along) / squared, 0.0, 1.0)} : s;
}

std::optional<WrapContact> overCylinder(const WrapObject& o, const Eigen::Vector3d& S, const Eigen::Vector3d& E) {
  const double radius = o.radii_m.x();
  const Eigen::Vector2d s = S.head<2>(), e = E.head<2>();
  if (s.norm() <= radius || e.norm() <= radius) return std::nullopt;
  const Eigen::Vector2d nearest = nearestToOrigin(s, e);
  const bool cuts = nearest.norm() < radius;
  const bool sided = o.side_sign != 0 && o.side_axis < 2;
  const auto onSide = [&](const Eigen::Vector2d& p) { return !sided || o.side_sign * p[o.side_axis] > 0; };
  if (!cuts && (!sided || onSide(nearest) || !(onSide(s) || onSide(e)))) return std::nullopt;

  std::optional<CircleWay> best;
  double best_2d = std::numeric_limits<double>::infinity();
  for (const int turn : {1, -1}) {
    const CircleWay way = circleWay(s, e, radius, turn);
    const double middle_rad = way.first_rad + turn * way.arc_rad / 2;
    if (!onSide({std::cos(middle_rad), std::sin(middle_rad)})) continue;
    const double length = way.first_tangent + radius * way.arc_rad + way.last_tangent;
    if (length < best_2d) {
      best_2d = length;
      best = way;
    }
  }
  if (!best) return std::nullopt;
  const double climb = (E.z() - S.z()) / best_2d;  // the same all the way: the surface unrolls into a plane
  WrapContact contact;
  contact.p_OFirst << radius * std::cos(best->first_rad), radius * std::sin(best->first_rad),
      S.z() + climb * best->first_tangent;
  contact.p_OLast << radius * std::cos(best->last_rad), radius * std::sin(best->last_rad),
      E.z() - climb * best->last_tangent;
  const double half_m = o.radii_m.z();
  if (std::abs(contact.p_OFirst.z()) > half_m && std::abs(contact.p_OLast.z()) > half_m) return std::nullopt;
  contact.arc_m = radius * best->arc_rad * std::hypot(1, climb);
  contact.length_m = best_2d * std::hypot(1, climb);
  return contact;
}

/// Length of the image of a circular arc under scaling by `radii`: centre + rho (cos t u + sin t m), t from `from` to
/// `to`. Five-point Gauss-Legendre on pieces of at most 15 deg: relative error below 1e-10 for axes of 1 : 3.
double scaledArc(const Eigen::Vector3d& radii, const Eigen::Vector3d& u, const Eigen::Vector3d& m, double rho,
                 double from, double to) {
  constexpr std::array<double, 5> node = {0, -0.5384693101056831, 0.5384693101056831, -0.9061798459386640,
                                          0.9061798459386640};
  constexpr std::array<double, 5> weight = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                            0.2369268850561891, 0.2369268850561891};
  const int pieces = 1 + static_cast<int>(std::abs(to - from) / (std::numbers::pi / 12));
  const double half = (to - from) / pieces / 2;
  double sum = 0;
  for (int i = 0; i < pieces; ++i)
    for (std::size_t k = 0; k < node.size(); ++k) {
      const double t = from + (2 * i + 1) * half + half * node[k];
      sum += weight[k] * radii.cwiseProduct(rho * (std::cos(t) * m - std::sin(t) * u)).norm();
    }
  return std::abs(half) * sum;
}

/// Ways over an ellipsoid in planes through S and E. Divided by the radii the ellipsoid is the unit sphere; planes,
/// tangents and their order stay.
class EllipsoidWays {
 public:
  EllipsoidWays(const WrapObject& o, const Eigen::Vector3d& S, const Eigen::Vector3d& E)
      : object_{o}, S_{S}, E_{E}, s_{S.cwiseQuotient(o.radii_m)}, e_{E.cwiseQuotient(o.radii_m)} {
    u_ = (e_ - s_).normalized();
    foot_ = s_ - u_ * u_.dot(s_);
    w_ = foot_.norm() > 1e-12 ? Eigen::Vector3d{foot_.normalized()} : u_.unitOrthogonal();
    v_ = u_.cross(w_);
  }

  /// The way that bulges towards cos(angle) w + sin(angle) v, where w points from the centre to the line.
  WrapContact way(double angle_rad) const {
    const Eigen::Vector3d m = std::cos(angle_rad) * w_ + std::sin(angle_rad) * v_;
    const Eigen::Vector3d centre = foot_ - m * foot_.dot(m);
    const double rho = std::sqrt(1 - centre.squaredNorm());
    const Eigen::Vector2d s2{(s_ - centre).dot(u_), (s_ - centre).dot(m)},
        e2{(e_ - centre).dot(u_), (e_ - centre).dot(m)};
    const CircleWay way = circleWay(s2, e2, rho, -1);
    const auto at = [&](double t) -> Eigen::Vector3d {
      return (centre + rho * (std::cos(t) * u_ + std::sin(t) * m)).cwiseProduct(object_.radii_m);
    };
    WrapContact contact;
    contact.p_OFirst = at(way.first_rad);
    contact.p_OLast = at(way.last_rad);
    contact.arc_m = scaledArc(object_.radii_m, u_, m, rho, way.first_rad, way.first_rad - way.arc_rad);
    contact.length_m = (contact.p_OFirst - S_).norm() + contact.arc_m + (E_ - contact.p_OLast).norm();
    return contact;
  }

  /// Whether a way bulges to the side that is asked for.
  bool isOnSide(double angle_rad) const {
    if (object_.side_sign == 0) return true;
    const Eigen::Vector3d m = std::cos(angle_rad) * w_ + std::sin(angle_rad) * v_;
    return object_.side_sign * m[object_.side_axis] > 0;
  }

 private:
  const WrapObject& object_;
  Eigen::Vector3d S_, E_, s_, e_, u_, foot_, w_, v_;
};

std::optional<WrapContact> overEllipsoid(const WrapObject& o, const Eigen::Vector3d& S, const Eigen::Vector3d& E) {
  const Eigen::Vector3d s = S.cwiseQuotient(o.radii_m), e = E.cwiseQuotient(o.radii_m);
  if (s.norm() <= 1 || e.norm() <= 1 || nearestToOrigin(s, e).norm() >= 1) return std::nullopt;
  const EllipsoidWays ways{o, S, E};
  constexpr int kPlanes = 36;
  const double step = kTurn_rad / kPlanes;
  double best = 0, shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kPlanes; ++i)
    if (const double length = ways.way(i * step).length_m; length < shortest) {
      shortest = length;
      best = i * step;
    }
  // Golden section between the neighbours: one valley.
  constexpr double kGolden = 0.6180339887498949, kEnough_rad = 1e-8;
  double low = best - step, high = best + step;
  while (high - low > kEnough_rad) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (ways.way(a).length_m < ways.way(b).length_m)
      high = b;
    else
      low = a;
  }
  best = (low + high) / 2;
  // On the other side nothing keeps a string from slipping off; it is led through the plane of the centre.
  return ways.way(ways.isOnSide(best) ? best : std::numbers::pi);
}

}  // namespace

std::optional<WrapContact> wrapOver(const WrapObject& object, const Eigen::Vector3d& p_OS,
                                    const Eigen::Vector3d& p_OE) {
  return object.shape == WrapShape::Cylinder ? overCylinder(object, p_OS, p_OE) : overEllipsoid(object, p_OS, p_OE);
}

}  // namespace sinew
