#include "core/posture/range_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHalfTurn_rad = kPi - 1e-6;  // as far as an image is clamped: the reverse has no direction

double wrapped(double angle_rad) {
  return std::remainder(angle_rad, 2 * kPi);
}

/// `v` with its angle to `centre` replaced, on the same great circle.
Eigen::Vector3d atAngle(const Eigen::Vector3d& centre, const Eigen::Vector3d& v, double angle_rad) {
  const Eigen::Vector3d across = v - centre * centre.dot(v);
  const double length = across.norm();
  if (length < 1e-12) return v;
  return std::cos(angle_rad) * centre + (std::sin(angle_rad) / length) * across;
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

// V~ of the last edit is V~ of those before it at T of the last: the newest is applied to a posture first.

double hingeImage(const RangeSteps& steps, double angle_rad) {
  for (auto s = steps.rbegin(); s != steps.rend(); ++s)
    angle_rad = s->centre_rad + std::clamp((angle_rad - s->centre_rad - s->shift_rad) / s->factor, -kPi, kPi);
  return angle_rad;
}

double hingePreimage(const RangeSteps& steps, double angle_rad) {
  for (const RangeStep& s : steps) angle_rad = s.centre_rad + s.shift_rad + s.factor * (angle_rad - s.centre_rad);
  return angle_rad;
}

std::optional<double> twistImage(const RangeSteps& steps, double twist_rad) {
  for (auto s = steps.rbegin(); s != steps.rend(); ++s) {
    if (s->factor == 1 && s->shift_rad == 0) continue;
    const double from_centre = wrapped(twist_rad - s->centre_rad - s->shift_rad) / s->factor;
    if (std::abs(from_centre) > kPi) return std::nullopt;
    twist_rad = wrapped(s->centre_rad + from_centre);
  }
  return twist_rad;
}

std::optional<Eigen::Vector3d> directionImage(const RangeSteps& steps, const Eigen::Vector3d& direction_J) {
  Eigen::Vector3d v = direction_J;
  for (auto s = steps.rbegin(); s != steps.rend(); ++s) {
    v = s->tilt_J.transpose() * v;
    if (s->cone_factor == 1) continue;
    const double angle = angleBetween(s->centre_J, v) / s->cone_factor;
    if (angle > kPi) return std::nullopt;
    v = atAngle(s->centre_J, v, angle);
  }
  return v;
}

TwistSwing ballPreimage(const RangeSteps& steps, const TwistSwing& orientation) {
  TwistSwing o = orientation;
  for (const RangeStep& s : steps) {
    if (s.factor != 1 || s.shift_rad != 0)
      o.twist_rad =
          wrapped(s.centre_rad + s.shift_rad +
                  std::clamp(s.factor * wrapped(o.twist_rad - s.centre_rad), -kHalfTurn_rad, kHalfTurn_rad));
    if (s.cone_factor != 1)
      o.direction_J = atAngle(s.centre_J, o.direction_J,
                              std::min(s.cone_factor * angleBetween(s.centre_J, o.direction_J), kHalfTurn_rad));
    o.direction_J = s.tilt_J * o.direction_J;
  }
  return o;
}

std::optional<Eigen::Matrix3d> ballImage(const EditedRange& range, const Eigen::Matrix3d& R_JB) {
  const TwistSwing o = twistSwingOf(range.shaft_J, Eigen::Quaterniond{R_JB});
  const auto twist = twistImage(range.steps, o.twist_rad);
  const auto direction = directionImage(range.steps, o.direction_J);
  if (!twist || !direction) return std::nullopt;
  return rotationOf(range.shaft_J, {*twist, *direction}).toRotationMatrix();
}

}  // namespace sinew
