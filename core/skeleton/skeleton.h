#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "core/skeleton/edited_range.h"

namespace sinew {

// The constant skeleton: 19 moving segments, 4 kinematically driven ones (patellae, radii), 18 joints and a free
// root, 50 coordinates. Axes of every segment frame B: X anterior, Y superior, Z to the subject's right (ISB, Wu
// 2002/2005), parallel to the world in the zero posture; radius and hand: X palmar, Y proximal, Z radial. Metres and
// radians.

enum class JointType { Free, Ball, Revolute };

/// One clinical degree of freedom. Ball joints and the root are read as an intrinsic sequence of turns about the axes
/// of their coordinates, in the order in which these are stored (Grood & Suntay 1983).
struct Coordinate {
  std::string name;  ///< "hip_flexion_r"; sides end in _r, _l
  int joint = -1;
  bool translational = false;
  Eigen::Vector3d axis;  ///< unit; positive turn = positive coordinate (signs of the left side included)
  double normal_min_rad = 0, normal_max_rad = 0;    ///< adult norm; metres if translational
  double athlete_min_rad = 0, athlete_max_rad = 0;  ///< what athletes reach: nobody goes beyond
  double stop_min_rad = 0, stop_max_rad = 0;        ///< bony and ligament stops of this body (core/rom/validity.h)
};

struct Joint {
  std::string name;
  JointType type = JointType::Ball;
  int parent = -1;  ///< segment; -1 = world
  int child = -1;
  RigidTransform X_PJ = RigidTransform::Identity();  ///< child frame in the parent frame at the zero posture
  int first_coordinate = 0;                          ///< index into q
  int coordinate_count = 0;                          ///< 6, 3 or 1
  EditedRange edited = {};                           ///< of a ball joint whose range was edited
};

struct Segment {
  std::string name;  ///< "femur_r"
  int parent = -1;   ///< segment it hangs on; -1 = world
  double mass_kg = 0;
  Eigen::Vector3d p_BCom = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_B_kgm2 = Eigen::Matrix3d::Zero();  ///< about the centre of mass
};

/// Named point of a bone.
struct Landmark {
  std::string name;  ///< "adductor_tubercle_r"
  int segment = -1;
  std::string bone;  ///< "femur"
  Eigen::Vector3d p_BL;
};

/// Patella: glides on a circle about the knee axis; its angle below the start is the integral of the quadriceps'
/// effective moment arm divided by the circle's radius (curve: Buford 1997, Krevolin 2004).
struct PatellaDriver {
  int segment = -1, femur = -1, knee_coordinate = -1;
  Eigen::Vector3d p_FK = Eigen::Vector3d::Zero();      ///< knee centre in the femur frame
  Eigen::Matrix3d R_FK = Eigen::Matrix3d::Identity();  ///< knee frame in the femur frame
  double radius_m = 0;                                 ///< of the circle of the patella's centre
  double start_rad = 0;  ///< angle of the centre above the anterior horizontal at full extension
  std::vector<double> knee_flexion_rad, quadriceps_arm_m;  ///< curve for the reference's radius
  double reference_radius_m = 0;

  /// Glide angle phi below the start, and dphi/d(knee flexion). Size cancels: radius and arm scale alike.
  std::array<double, 2> glide(double knee_flexion_rad) const;
};

/// Image under reflection in the plane Z = 0, which takes right to left.
inline Eigen::Vector3d mirrored(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), -p.z()};
}
/// The same turn seen in the mirror: axial vectors keep their Z.
inline Eigen::Vector3d mirroredAxis(const Eigen::Vector3d& axis) {
  return {-axis.x(), -axis.y(), axis.z()};
}
RigidTransform mirrored(const RigidTransform& X);

/// Radius: turns about the axis a_ps through its head and the wrist centre, with the axial part of the wrist
/// rotation.
struct RadiusDriver {
  int segment = -1, ulna = -1, wrist_joint = -1;
  Eigen::Vector3d p_UR = Eigen::Vector3d::Zero();     ///< radial head centre in the ulna frame
  Eigen::Vector3d axis_U = Eigen::Vector3d::UnitY();  ///< positive pronation; same components in ulna and radius
};

struct Skeleton {
  std::vector<Segment> segments;  ///< moving ones first (segment i is the child of joint i), then the driven ones
  std::vector<Joint> joints;      ///< parents before children; joint 0 is the free root
  std::vector<Coordinate> coordinates;
  std::vector<Landmark> landmarks;
  std::array<PatellaDriver, 2> patellae;  ///< right, left
  std::array<RadiusDriver, 2> radii;

  int coordinateCount() const { return static_cast<int>(coordinates.size()); }
  int movingSegmentCount() const { return static_cast<int>(joints.size()); }

  /// Index by name. @throws InputError with the nearest names if there is none.
  int segmentIndex(std::string_view name) const;
  int jointIndex(std::string_view name) const;
  int coordinateIndex(std::string_view name) const;
  int landmarkIndex(std::string_view name) const;
  const Landmark& landmark(std::string_view name) const { return landmarks[landmarkIndex(name)]; }
};

/// +1 for right and midline names, -1 for names that end in "_l".
inline int sideSign(std::string_view name) {
  return name.ends_with("_l") ? -1 : 1;
}
/// "femur_r" -> "femur".
inline std::string_view withoutSide(std::string_view name) {
  return name.ends_with("_l") || name.ends_with("_r") ? name.substr(0, name.size() - 2) : name;
}

/// Reads reference_skeleton.json and landmarks.csv (right side and midline; the left side is the mirror image).
/// @throws InputError naming file, entry, expected and found.
Skeleton loadReferenceSkeleton(const std::filesystem::path& resource_dir);

}  // namespace sinew
