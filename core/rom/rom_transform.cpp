#include "core/rom/rom_transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/rom/rom_map.h"

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

std::vector<Eigen::Vector3d> shafts(const Skeleton& skeleton) {
  std::vector<Eigen::Vector3d> shaft_J;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    shaft_J.push_back(skeleton.joints[j].type == JointType::Ball ? romMapFrame(skeleton, static_cast<int>(j)).shaft_J
                                                                 : Eigen::Vector3d::Zero());
  return shaft_J;
}

TwistSwing orientationOf(const Eigen::Vector3d& shaft_J, const Eigen::Vector3d& vector) {
  return twistSwingOf(shaft_J, quaternionFromVector(vector));
}

}  // namespace

RomCentres romCentres(const Skeleton& skeleton, const PoseStream& poses) {
  const std::size_t n = skeleton.joints.size();
  const auto shaft_J = shafts(skeleton);
  std::vector<double> sum(n, 0), sine(n, 0), cosine(n, 0);
  std::vector<Eigen::Vector3d> direction(n, Eigen::Vector3d::Zero());
  Eigen::Index count = 0;
  poses([&](const Eigen::MatrixXd& block) {
    for (Eigen::Index p = 0; p < block.cols(); ++p)
      for (std::size_t j = 0; j < n; ++j) {
        const Joint& joint = skeleton.joints[j];
        if (joint.type == JointType::Revolute) sum[j] += block(joint.first_coordinate, p);
        if (joint.type != JointType::Ball) continue;
        const TwistSwing o = orientationOf(shaft_J[j], block.col(p).segment<3>(joint.first_coordinate));
        sine[j] += std::sin(o.twist_rad);
        cosine[j] += std::cos(o.twist_rad);
        direction[j] += o.direction_J;
      }
    count += block.cols();
  });
  require(count > 0, "romCentres: a pose set that is not empty");
  RomCentres centres{std::vector<double>(n), std::vector<double>(n), direction};
  for (std::size_t j = 0; j < n; ++j) {
    centres.angle_rad[j] = sum[j] / double(count);
    centres.twist_rad[j] = std::atan2(sine[j], cosine[j]);
    centres.direction_J[j] = direction[j].norm() > 1e-9 ? direction[j].normalized() : shaft_J[j];
  }
  return centres;
}

RomTransform::RomTransform(const Skeleton& skeleton, const RomCentres& centres, const RomEdits& edits,
                           const std::string& where)
    : skeleton_{&skeleton}, steps_(skeleton.joints.size()), shaft_J_{shafts(skeleton)} {
  checkRomEdits(skeleton, edits, where);
  for (const RomEdit& e : edits) {
    if (e.isIdentity()) continue;
    const int j = skeleton.jointIndex(e.joint);
    const bool hinge = skeleton.joints[j].type == JointType::Revolute;
    Step step;
    step.factor = hinge ? e.range_factor : e.twist_factor;
    step.shift_rad = hinge ? e.shift_rad : twistSign(skeleton, j) * e.twist_shift_rad;
    step.cone_factor = e.cone_factor;
    step.tilt_J = rotationFromVector<double>(tiltVector_J(skeleton, j, e.tilt, where));
    if (steps_[j].empty()) {
      step.centre_rad = hinge ? centres.angle_rad[j] : centres.twist_rad[j];
      step.centre_J = centres.direction_J[j];
    } else {
      const Step& before = steps_[j].back();
      step.centre_rad = before.centre_rad + before.shift_rad;
      step.centre_J = before.tilt_J * before.centre_J;
    }
    steps_[j].push_back(step);
  }
  for (std::size_t j = 0; j < steps_.size(); ++j)
    if (!steps_[j].empty()) joints_.push_back(static_cast<int>(j));
}

// V~ of the last edit is V~ of those before it at T of the last: the newest is applied to a posture first.

double RomTransform::hinge(int joint, double angle_rad) const {
  for (auto s = steps_[joint].rbegin(); s != steps_[joint].rend(); ++s)
    angle_rad = s->centre_rad + std::clamp((angle_rad - s->centre_rad - s->shift_rad) / s->factor, -kPi, kPi);
  return angle_rad;
}

double RomTransform::hingeInverse(int joint, double angle_rad) const {
  for (const Step& s : steps_[joint]) angle_rad = s.centre_rad + s.shift_rad + s.factor * (angle_rad - s.centre_rad);
  return angle_rad;
}

std::optional<double> RomTransform::twist(int joint, double twist_rad) const {
  for (auto s = steps_[joint].rbegin(); s != steps_[joint].rend(); ++s) {
    if (s->factor == 1 && s->shift_rad == 0) continue;
    const double from_centre = wrapped(twist_rad - s->centre_rad - s->shift_rad) / s->factor;
    if (std::abs(from_centre) > kPi) return std::nullopt;
    twist_rad = wrapped(s->centre_rad + from_centre);
  }
  return twist_rad;
}

std::optional<Eigen::Vector3d> RomTransform::direction(int joint, const Eigen::Vector3d& direction_J) const {
  Eigen::Vector3d v = direction_J;
  for (auto s = steps_[joint].rbegin(); s != steps_[joint].rend(); ++s) {
    v = s->tilt_J.transpose() * v;
    if (s->cone_factor == 1) continue;
    const double angle = angleBetween(s->centre_J, v) / s->cone_factor;
    if (angle > kPi) return std::nullopt;
    v = atAngle(s->centre_J, v, angle);
  }
  return v;
}

std::optional<TwistSwing> RomTransform::ball(int joint, const TwistSwing& orientation) const {
  const auto t = twist(joint, orientation.twist_rad);
  const auto v = direction(joint, orientation.direction_J);
  if (!t || !v) return std::nullopt;
  return TwistSwing{*t, *v};
}

TwistSwing RomTransform::ballInverse(int joint, const TwistSwing& orientation) const {
  TwistSwing o = orientation;
  for (const Step& s : steps_[joint]) {
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

std::optional<Posture> RomTransform::apply(const Posture& q, int except_joint) const {
  Posture result = q;
  for (const int j : joints_) {
    if (j == except_joint) continue;
    const Joint& joint = skeleton_->joints[j];
    if (joint.type == JointType::Revolute) {
      result[joint.first_coordinate] = hinge(j, q[joint.first_coordinate]);
      continue;
    }
    const auto o = ball(j, orientationOf(shaft_J_[j], q.segment<3>(joint.first_coordinate)));
    if (!o) return std::nullopt;
    result.segment<3>(joint.first_coordinate) = vectorFromQuaternion(rotationOf(shaft_J_[j], *o));
  }
  return result;
}

Posture RomTransform::inverse(const Posture& q) const {
  Posture result = q;
  invert(result);
  return result;
}

void RomTransform::invert(Eigen::Ref<Posture> q) const {
  for (const int j : joints_) {
    const Joint& joint = skeleton_->joints[j];
    if (joint.type == JointType::Revolute) {
      q[joint.first_coordinate] = hingeInverse(j, q[joint.first_coordinate]);
      continue;
    }
    const TwistSwing o = ballInverse(j, orientationOf(shaft_J_[j], q.segment<3>(joint.first_coordinate)));
    q.segment<3>(joint.first_coordinate) = vectorFromQuaternion(rotationOf(shaft_J_[j], o));
  }
}

}  // namespace sinew
