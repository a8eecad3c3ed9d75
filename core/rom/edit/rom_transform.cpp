#include "core/rom/edit/rom_transform.h"

#include <cmath>

#include "core/error.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {
namespace {

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
    RangeStep step;
    step.factor = hinge ? e.range_factor : e.twist_factor;
    step.shift_rad = hinge ? e.shift_rad : twistSign(skeleton, j) * e.twist_shift_rad;
    step.cone_factor = e.cone_factor;
    step.tilt_J = rotationFromVector<double>(tiltVector_J(skeleton, j, e.tilt, where));
    if (steps_[j].empty()) {
      step.centre_rad = hinge ? centres.angle_rad[j] : centres.twist_rad[j];
      step.centre_J = centres.direction_J[j];
    } else {
      const RangeStep& before = steps_[j].back();
      step.centre_rad = before.centre_rad + before.shift_rad;
      step.centre_J = before.tilt_J * before.centre_J;
    }
    steps_[j].push_back(step);
  }
  for (std::size_t j = 0; j < steps_.size(); ++j)
    if (!steps_[j].empty()) joints_.push_back(static_cast<int>(j));
}

double RomTransform::hinge(int joint, double angle_rad) const {
  return hingeImage(steps_[joint], angle_rad);
}

double RomTransform::hingeInverse(int joint, double angle_rad) const {
  return hingePreimage(steps_[joint], angle_rad);
}

std::optional<double> RomTransform::twist(int joint, double twist_rad) const {
  return twistImage(steps_[joint], twist_rad);
}

std::optional<Eigen::Vector3d> RomTransform::direction(int joint, const Eigen::Vector3d& direction_J) const {
  return directionImage(steps_[joint], direction_J);
}

std::optional<TwistSwing> RomTransform::ball(int joint, const TwistSwing& orientation) const {
  const auto t = twist(joint, orientation.twist_rad);
  const auto v = direction(joint, orientation.direction_J);
  if (!t || !v) return std::nullopt;
  return TwistSwing{*t, *v};
}

TwistSwing RomTransform::ballInverse(int joint, const TwistSwing& orientation) const {
  return ballPreimage(steps_[joint], orientation);
}

EditedRange RomTransform::editedRange(int joint) const {
  const Joint& j = skeleton_->joints[joint];
  EditedRange range = j.edited;
  if (range.steps.empty()) {
    range.shaft_J = shaft_J_[joint];
    for (int i = 0; i < 3; ++i) {
      range.stop_min_rad[i] = skeleton_->coordinates[j.first_coordinate + i].stop_min_rad;
      range.stop_max_rad[i] = skeleton_->coordinates[j.first_coordinate + i].stop_max_rad;
    }
  }
  range.steps.insert(range.steps.end(), steps_[joint].begin(), steps_[joint].end());
  return range;
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
