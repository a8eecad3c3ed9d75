#include "core/io/motion/bvh_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/io/motion/bvh_ik_internal.h"
#include "core/io/motion/bvh_roles_internal.h"

namespace sinew {
namespace {

/// Limbs whose direction counts: from the joint centre of one segment to that of the next.
struct Limb {
  const char *from, *to;
};
constexpr Limb kLimbs[] = {{"femur_r", "tibia_r"},  {"tibia_r", "foot_r"},  {"humerus_r", "ulna_r"},
                           {"ulna_r", "hand_r"},    {"femur_l", "tibia_l"}, {"tibia_l", "foot_l"},
                           {"humerus_l", "ulna_l"}, {"ulna_l", "hand_l"}};

/// "Character1_LeftUpLeg", "mixamorig:LeftUpLeg" -> "leftupleg".
std::string plainName(const std::string& name) {
  std::string plain = name.substr(name.find_last_of(":_") == std::string::npos ? 0 : name.find_last_of(":_") + 1);
  std::ranges::transform(plain, plain.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return plain;
}

int jointNamed(const BvhMotion& motion, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    for (std::size_t i = 0; i < motion.joints.size(); ++i)
      if (!motion.joints[i].channels.empty() && plainName(motion.joints[i].name) == plainName(name))
        return static_cast<int>(i);
  return -1;
}

/// Ties the joints of a file to our segments.
class Mapping {
 public:
  Mapping(const BvhMotion& motion, const std::string& where, const Skeleton& skeleton,
          const MotionImportOptions& options)
      : motion_{motion}, skeleton_{skeleton} {
    joint_.assign(skeleton.segments.size(), -1);
    std::string missing;
    for (const BvhRole& role : bvhRoles()) {
      const int joint = jointNamed(motion, role.joints);
      if (joint < 0 && role.required) missing += (missing.empty() ? "" : ", ") + role.joints.front();
      joint_[skeleton.segmentIndex(role.segment)] = joint;
    }
    if (!missing.empty())
      throw InputError{{where, "joints", "the joints of a body, CMU-style names", "no " + missing}};
    // One joint may not carry two segments: the lower one then has none of its own.
    if (joint_[segment("lumbar")] == joint_[segment("thorax")]) joint_[segment("lumbar")] = -1;
    findAxes(where);
    meetRestPose(options);
  }

  double scale() const { return scale_; }
  const Posture& rest() const { return rest_; }
  int jointOf(int segment) const { return joint_[segment]; }

  BvhTargets targets(int frame) const {
    BvhTargets t = directions(bvhPoses(motion_, frame));
    const auto X = bvhPoses(motion_, frame);
    for (const BvhRole& role : bvhRoles()) {
      const int s = segment(role.segment);
      if (joint_[s] < 0) continue;
      const Eigen::Matrix3d turn_W = R_WF_ * X[joint_[s]].linear() * R_WF_.transpose();
      t.turns.push_back({s, role.turn_weight, turn_W * R_WB_rest_[s]});
    }
    return t;
  }

 private:
  int segment(const char* name) const { return skeleton_.segmentIndex(name); }
  Eigen::Vector3d place(const std::vector<RigidTransform>& X, const char* segment_name) const {
    return R_WF_ * X[joint_[segment(segment_name)]].translation();
  }

  /// World of the file F in ours, from the rest pose: up along the body, right from the left to the right hip.
  void findAxes(const std::string& where) {
    const auto X = bvhPoses(motion_, -1);
    const auto at = [&](const char* name) { return X[joint_[segment(name)]].translation(); };
    const Eigen::Vector3d right = at("femur_r") - at("femur_l"), middle = 0.5 * (at("femur_r") + at("femur_l"));
    Eigen::Vector3d up = at("thorax") - 0.5 * (at("foot_r") + at("foot_l"));
    up -= up.dot(right) / right.squaredNorm() * right;
    const double leg = 0.5 * ((at("tibia_r") - at("femur_r")).norm() + (at("foot_r") - at("tibia_r")).norm() +
                              (at("tibia_l") - at("femur_l")).norm() + (at("foot_l") - at("tibia_l")).norm());
    if (!(right.norm() > 0.01 * leg) || !(up.norm() > 0.5 * leg) || !((middle - at("foot_r")).norm() > 0.5 * leg))
      throw InputError{{where, "rest pose", "a body upright, its hips apart", "another arrangement of the joints"}};
    // The file's up is one of its axes; the body only tells which.
    const auto nearestAxis = [](const Eigen::Vector3d& v) {
      Eigen::Index i = 0;
      v.cwiseAbs().maxCoeff(&i);
      return Eigen::Vector3d{Eigen::Vector3d::Unit(i) * (v[i] > 0 ? 1.0 : -1.0)};
    };
    const Eigen::Vector3d y = nearestAxis(up);
    const Eigen::Vector3d z = (right - right.dot(y) * y).normalized(), x = y.cross(z);
    R_WF_.row(0) = x, R_WF_.row(1) = y, R_WF_.row(2) = z;
    const auto X_zero = segmentPoses(skeleton_, zeroPosture(skeleton_));
    const auto ours = [&](const char* name) { return X_zero[segment(name)].translation(); };
    scale_ = ((ours("tibia_r") - ours("femur_r")).norm() + (ours("foot_r") - ours("tibia_r")).norm()) / leg;
  }

  BvhTargets directions(const std::vector<RigidTransform>& X) const {
    BvhTargets t;
    for (const Limb& limb : kLimbs)
      t.directions.push_back(
          {segment(limb.from), segment(limb.to), (place(X, limb.to) - place(X, limb.from)).normalized()});
    t.p_WPelvis = scale_ * 0.5 * (place(X, "femur_r") + place(X, "femur_l"));
    return t;
  }

  /// Our T turned until its limbs lie as those of the file's rest pose: the turns that belong to no turns there.
  void meetRestPose(const MotionImportOptions& options) {
    BvhTargets t = directions(bvhPoses(motion_, -1));
    const Posture T = restOfRigs(skeleton_);
    const auto X_T = segmentPoses(skeleton_, T);
    for (const BvhRole& role : bvhRoles()) {
      const double stiff = role.turn_weight >= 0.3 ? 1 : 0.05;  // limbs give way to their directions
      t.turns.push_back({segment(role.segment), stiff, X_T[segment(role.segment)].linear()});
    }
    rest_ = BvhInverseKinematics{skeleton_, options}.solve(T, t);
    for (const RigidTransform& X : segmentPoses(skeleton_, rest_)) R_WB_rest_.push_back(X.linear());
  }

  const BvhMotion& motion_;
  const Skeleton& skeleton_;
  std::vector<int> joint_;  ///< by segment; -1: none
  Eigen::Matrix3d R_WF_ = Eigen::Matrix3d::Identity();
  double scale_ = 1;
  Posture rest_;
  std::vector<Eigen::Matrix3d> R_WB_rest_;
};

void measure(const Skeleton& skeleton, const Posture& q, const BvhTargets& targets, int frame, MotionImport& import,
             double& sum_deg2) {
  const auto X_WB = segmentPoses(skeleton, q);
  for (const auto& d : targets.directions) {
    const Eigen::Vector3d u = (X_WB[d.to].translation() - X_WB[d.from].translation()).normalized();
    const double deg = std::atan2(u.cross(d.direction_W).norm(), u.dot(d.direction_W)) * kDegPerRad;
    sum_deg2 += deg * deg;
    if (deg > import.worst_deg || import.worst_frame < 0) {
      import.worst_deg = deg;
      import.worst_frame = frame;
      import.worst_segment = skeleton.segments[d.from].name;
    }
  }
}

}  // namespace

MotionImport importMotion(const BvhMotion& motion, const std::string& where, const Skeleton& skeleton,
                          const MotionImportOptions& options, const Job& job) {
  require(options.step >= 1, "importMotion: a step of at least 1");
  const Mapping mapping{motion, where, skeleton, options};
  const BvhInverseKinematics solver{skeleton, options};
  MotionImport import{.poses = PoseSet{skeleton, where}, .frames = static_cast<int>(motion.channels.cols())};
  import.scale = mapping.scale();
  Posture q = mapping.rest();
  double sum_deg2 = 0;
  for (int frame = 0; frame < import.frames; frame += options.step) {
    if (job.cancelled()) break;
    job.report(double(frame) / import.frames, "inverse kinematics of " + where);
    const BvhTargets targets = mapping.targets(frame);
    q = solver.solve(q, targets);
    import.poses.add(q);
    measure(skeleton, q, targets, frame, import, sum_deg2);
  }
  if (import.poses.size() > 0)
    import.rms_deg = std::sqrt(sum_deg2 / (static_cast<double>(import.poses.size()) * std::size(kLimbs)));
  for (std::size_t j = 0; j < motion.joints.size(); ++j) {
    bool used = motion.joints[j].channels.empty();
    for (std::size_t s = 0; s < skeleton.segments.size(); ++s)
      used = used || mapping.jointOf(static_cast<int>(s)) == static_cast<int>(j);
    if (!used) import.unused.push_back(motion.joints[j].name);
  }
  return import;
}

}  // namespace sinew
