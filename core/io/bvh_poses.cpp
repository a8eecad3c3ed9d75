#include "core/io/bvh_poses.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/error.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kDegPerRad = 180 / std::numbers::pi;

/// A segment and the joint of the file that carries it.
struct Role {
  const char* segment;
  std::vector<std::string> joints;  ///< names, the first that exists
  double turn_weight;               ///< how much the joint's turn counts; small where only the direction is sure
  bool required;
};
const std::vector<Role>& roles() {
  static const std::vector<Role> all = [] {
    std::vector<Role> list{{"pelvis", {"Hips", "Hip", "Pelvis"}, 1, true},
                           {"lumbar", {"LowerBack", "Spine", "Abdomen"}, 0.4, false},
                           {"thorax", {"Spine3", "Spine2", "Spine1", "Chest", "Thorax", "Spine"}, 1, true},
                           {"neck", {"Neck", "Neck1"}, 0.3, false},
                           {"head", {"Head"}, 0.7, false}};
    for (const bool left : {false, true}) {
      const auto named = [&](std::initializer_list<const char*> names) {
        std::vector<std::string> result;
        for (const char* name : names) result.push_back((left ? "Left" : "Right") + std::string{name});
        return result;
      };
      const auto segment = [&](const char* right, const char* l) { return left ? l : right; };
      list.push_back({segment("scapula_r", "scapula_l"), named({"Shoulder", "Collar"}), 0.5, false});
      list.push_back({segment("humerus_r", "humerus_l"), named({"Arm", "UpArm", "UpperArm"}), 0.1, true});
      list.push_back({segment("ulna_r", "ulna_l"), named({"ForeArm", "LowArm", "Elbow"}), 0.05, true});
      list.push_back({segment("hand_r", "hand_l"), named({"Hand", "Wrist"}), 0.5, true});
      list.push_back({segment("femur_r", "femur_l"), named({"UpLeg", "Thigh"}), 0.1, true});
      list.push_back({segment("tibia_r", "tibia_l"), named({"Leg", "LowLeg", "Shin", "Knee"}), 0.1, true});
      list.push_back({segment("foot_r", "foot_l"), named({"Foot", "Ankle"}), 0.7, true});
    }
    return list;
  }();
  return all;
}

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

Eigen::Matrix3d turnBetween(const Eigen::Matrix3d& R_WA, const Eigen::Matrix3d& R_WB) {
  return R_WB * R_WA.transpose();
}

/// What a rig at rest looks like: arms sideways from a girdle that hangs as in standing.
Posture restOfRigs(const Skeleton& skeleton) {
  return postureFromDegrees(skeleton, {{"shoulder_adduction_r", -90}, {"shoulder_adduction_l", -90}});
}

/// What the solver aims at in one frame.
struct Targets {
  struct Turn {
    int segment;
    double weight;
    Eigen::Matrix3d R_WB;
  };
  struct Direction {
    int from, to;
    Eigen::Vector3d direction_W;
  };
  std::vector<Turn> turns;
  std::vector<Direction> directions;
  Eigen::Vector3d p_WPelvis = Eigen::Vector3d::Zero();
};

/// Gauss-Newton over all coordinates, from where the turns of the joints alone lead; a step that makes it worse is
/// taken back and damped. A weak pull to the start decides what nothing else does.
class InverseKinematics {
 public:
  InverseKinematics(const Skeleton& skeleton, const MotionImportOptions& options)
      : skeleton_{skeleton}, options_{options} {}

  /// Every joint turned as its targets say, hinges as far as they can; joints without a target as in `otherwise`.
  Posture turned(const Posture& otherwise, const Targets& targets) const {
    Posture q = otherwise;
    q.head<3>() = targets.p_WPelvis - skeleton_.joints[0].X_PJ.translation();
    std::vector<Eigen::Matrix3d> R_WB(skeleton_.joints.size());
    for (const Joint& joint : skeleton_.joints) {
      Eigen::Matrix3d R_WJ = joint.X_PJ.linear();
      if (joint.parent >= 0) R_WJ = R_WB[joint.parent] * R_WJ;
      const int r = joint.first_coordinate + (joint.type == JointType::Free ? 3 : 0);
      const bool hinge = joint.type == JointType::Revolute;
      const Eigen::Vector3d& axis = skeleton_.coordinates[r].axis;
      const auto target = std::ranges::find(targets.turns, joint.child, &Targets::Turn::segment);
      if (target != targets.turns.end()) {
        const Eigen::Matrix3d R_JB = R_WJ.transpose() * target->R_WB;
        const Eigen::Quaterniond turn{R_JB};
        if (hinge)
          q[r] = std::remainder(2 * std::atan2(turn.vec().dot(axis), turn.w()), 2 * std::numbers::pi);
        else
          q.segment<3>(r) = vectorFromRotation(R_JB);
      }
      R_WB[joint.child] = R_WJ * (hinge ? rotationAbout<double>(axis, q[r])
                                        : rotationFromVector<double>(Eigen::Vector3d{q.segment<3>(r)}));
    }
    keepInside(q);
    return q;
  }

  Posture solve(const Posture& otherwise, const Targets& targets) const {
    const Posture start = turned(otherwise, targets);
    Posture q = start;
    double cost = costAt(q, start, targets), damping = kPull;
    for (int i = 0; i < options_.iterations && damping < 1e6; ++i) {
      Eigen::MatrixXd H = Eigen::MatrixXd::Zero(q.size(), q.size());
      Eigen::VectorXd g = kPull * (start - q);
      accumulate(q, targets, H, g);
      H.diagonal().array() += damping;
      for (int k = 0; k < 3; ++k) H.row(k).setZero(), H.col(k).setZero(), H(k, k) = 1, g[k] = 0;  // placed already
      const Eigen::VectorXd step = H.ldlt().solve(g);
      Posture tried = q + step;
      keepInside(tried);
      const double tried_cost = costAt(tried, start, targets);
      if (tried_cost > cost) {
        damping *= 10;
        continue;
      }
      q = tried;
      cost = tried_cost;
      damping = std::max(kPull, damping / 10);
      if (step.lpNorm<Eigen::Infinity>() < options_.tolerance) break;
    }
    return q;
  }

 private:
  static constexpr double kPull = 1e-6;

  double costAt(const Posture& q, const Posture& start, const Targets& targets) const {
    const auto X_WB = segmentPoses(skeleton_, q);
    double cost = kPull * (q - start).squaredNorm();
    for (const auto& t : targets.turns)
      cost += t.weight * t.weight * vectorFromRotation(turnBetween(t.R_WB, X_WB[t.segment].linear())).squaredNorm();
    for (const auto& d : targets.directions) {
      const Eigen::Vector3d along = X_WB[d.to].translation() - X_WB[d.from].translation();
      cost += (along.normalized() - d.direction_W).squaredNorm();
    }
    return cost;
  }

  void accumulate(const Posture& q, const Targets& targets, Eigen::MatrixXd& H, Eigen::VectorXd& g) const {
    const Kinematics k = kinematics(skeleton_, q);
    const auto add = [&](const Eigen::Matrix3Xd& J, const Eigen::Vector3d& residual, double weight) {
      H += weight * weight * J.transpose() * J;
      g -= weight * weight * J.transpose() * residual;
    };
    for (const auto& t : targets.turns) {
      Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, q.size());
      for (const SegmentMotion& m : k.motions[t.segment]) J.col(m.coordinate) += m.twist.w;
      add(J, vectorFromRotation(turnBetween(t.R_WB, k.X_WB[t.segment].linear())), t.weight);
    }
    for (const auto& d : targets.directions) {
      const Eigen::Vector3d along = k.X_WB[d.to].translation() - k.X_WB[d.from].translation();
      const double length = along.norm();
      const Eigen::Vector3d u = along / length;
      const Eigen::Matrix3Xd J = (Eigen::Matrix3d::Identity() - u * u.transpose()) / length *
                                 (pointJacobian(skeleton_, k, d.to, Eigen::Vector3d::Zero()) -
                                  pointJacobian(skeleton_, k, d.from, Eigen::Vector3d::Zero()));
      add(J, u - d.direction_W, 1);
    }
  }

  /// Hinges stay in the athlete's range; turns stay below half a turn, where the rotation vector is unique.
  void keepInside(Posture& q) const {
    for (const Joint& joint : skeleton_.joints) {
      const int r = joint.first_coordinate + (joint.type == JointType::Free ? 3 : 0);
      const Coordinate& c = skeleton_.coordinates[r];
      if (joint.type == JointType::Revolute)
        q[r] = std::clamp(q[r], c.athlete_min_rad, c.athlete_max_rad);
      else if (q.segment<3>(r).norm() > std::numbers::pi)
        q.segment<3>(r) = vectorFromRotation(rotationFromVector<double>(q.segment<3>(r)));
    }
  }

  const Skeleton& skeleton_;
  const MotionImportOptions& options_;
};

/// Ties the joints of a file to our segments.
class Mapping {
 public:
  Mapping(const BvhMotion& motion, const std::string& where, const Skeleton& skeleton,
          const MotionImportOptions& options)
      : motion_{motion}, skeleton_{skeleton} {
    joint_.assign(skeleton.segments.size(), -1);
    std::string missing;
    for (const Role& role : roles()) {
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

  Targets targets(int frame) const {
    Targets t = directions(bvhPoses(motion_, frame));
    const auto X = bvhPoses(motion_, frame);
    for (const Role& role : roles()) {
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

  Targets directions(const std::vector<RigidTransform>& X) const {
    Targets t;
    for (const Limb& limb : kLimbs)
      t.directions.push_back(
          {segment(limb.from), segment(limb.to), (place(X, limb.to) - place(X, limb.from)).normalized()});
    t.p_WPelvis = scale_ * 0.5 * (place(X, "femur_r") + place(X, "femur_l"));
    return t;
  }

  /// Our T turned until its limbs lie as those of the file's rest pose: the turns that belong to no turns there.
  void meetRestPose(const MotionImportOptions& options) {
    Targets t = directions(bvhPoses(motion_, -1));
    const Posture T = restOfRigs(skeleton_);
    const auto X_T = segmentPoses(skeleton_, T);
    for (const Role& role : roles()) {
      const double stiff = role.turn_weight >= 0.3 ? 1 : 0.05;  // limbs give way to their directions
      t.turns.push_back({segment(role.segment), stiff, X_T[segment(role.segment)].linear()});
    }
    rest_ = InverseKinematics{skeleton_, options}.solve(T, t);
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

void measure(const Skeleton& skeleton, const Posture& q, const Targets& targets, int frame, MotionImport& import,
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
  const InverseKinematics solver{skeleton, options};
  MotionImport import{.poses = PoseSet{skeleton, where}, .frames = static_cast<int>(motion.channels.cols())};
  import.scale = mapping.scale();
  Posture q = mapping.rest();
  double sum_deg2 = 0;
  for (int frame = 0; frame < import.frames; frame += options.step) {
    if (job.cancelled()) break;
    job.report(double(frame) / import.frames, "inverse kinematics of " + where);
    const Targets targets = mapping.targets(frame);
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

BvhMotion motionFromPostures(const Skeleton& skeleton, const std::vector<Posture>& postures, double frame_time_s) {
  constexpr double kCentimetres = 100;
  // W to the file's world: x left = -Z, y up = Y, z forward = X.
  Eigen::Matrix3d R_FW;
  R_FW << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  const auto X_rest = segmentPoses(skeleton, restOfRigs(skeleton));
  BvhMotion motion{.frame_time_s = frame_time_s};
  std::vector<int> joint_of(skeleton.segments.size(), -1), segment_of;
  int channels = 0;
  for (const Joint& j : skeleton.joints) {
    const auto role =
        std::ranges::find_if(roles(), [&](const Role& r) { return skeleton.segments[j.child].name == r.segment; });
    std::string name = role->joints.front();
    if (name == "LowerBack") name = "Spine";
    if (name == "Spine3") name = "Spine1";
    BvhJoint joint{.name = name, .parent = j.parent < 0 ? -1 : joint_of[j.parent]};
    Eigen::Vector3d from = Eigen::Vector3d::Zero();
    if (j.parent >= 0) from = X_rest[j.parent].translation();
    joint.offset = kCentimetres * R_FW * (X_rest[j.child].translation() - from);
    joint.first_channel = channels;
    if (j.parent < 0) joint.channels = {BvhChannel::Xposition, BvhChannel::Yposition, BvhChannel::Zposition};
    for (const BvhChannel c : {BvhChannel::Zrotation, BvhChannel::Xrotation, BvhChannel::Yrotation})
      joint.channels.push_back(c);
    channels += static_cast<int>(joint.channels.size());
    joint_of[j.child] = static_cast<int>(motion.joints.size());
    segment_of.push_back(j.child);
    motion.joints.push_back(joint);
  }
  motion.channels.resize(channels, static_cast<Eigen::Index>(postures.size()));
  for (std::size_t f = 0; f < postures.size(); ++f) {
    const auto X_WB = segmentPoses(skeleton, postures[f]);
    std::vector<Eigen::Matrix3d> R_F;  // turn of every joint since the rest pose
    for (std::size_t j = 0; j < motion.joints.size(); ++j) {
      const int s = segment_of[j];
      R_F.push_back(R_FW * turnBetween(X_rest[s].linear(), X_WB[s].linear()) * R_FW.transpose());
      const BvhJoint& joint = motion.joints[j];
      const Eigen::Matrix3d R = joint.parent < 0 ? R_F[j] : Eigen::Matrix3d{R_F[joint.parent].transpose() * R_F[j]};
      int c = joint.first_channel;
      const Eigen::Vector3d place = kCentimetres * R_FW * X_WB[s].translation();
      if (joint.parent < 0)
        for (const double x : place) motion.channels(c++, static_cast<Eigen::Index>(f)) = x;
      // R = Rz(a) Rx(b) Ry(c)
      const double b = std::asin(std::clamp(R(2, 1), -1.0, 1.0));
      for (const double angle : {std::atan2(-R(0, 1), R(1, 1)), b, std::atan2(-R(2, 0), R(2, 2))})
        motion.channels(c++, static_cast<Eigen::Index>(f)) = angle * kDegPerRad;
    }
  }
  return motion;
}

}  // namespace sinew
