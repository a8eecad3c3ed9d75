#pragma once
// Definitions of the templates of bone_field.h. Fields of the right side; the left side goes through the mirror.
// T: scalar of the parameters and of the result; U: scalar of the point, double or T.
#include "core/skeleton/shape/bone_field.h"
#include "core/skeleton/shape/limb_bends_internal.h"
#include "core/skeleton/shape/trunk_field_internal.h"

namespace sinew {
namespace field {

// Places of the parameters in the flat list of shapeParameterNames(); of the trunk and of one side: in the files
// above.
constexpr int kPelvisWidth = 0, kPelvisHeight = 1, kPelvisDepth = 2, kNeckElongation = 6, kHeadScale = 7,
              kSideBegin = 8;

/// Which field a segment follows.
enum class Kind {
  Pelvis,
  Femur,
  Tibia,
  Foot,
  Lumbar,
  Thorax,
  Neck,
  Head,
  Scapula,
  Humerus,
  Ulna,
  Hand,
  Patella,
  Radius
};
Kind kindOf(const std::string& segment_name);

/// The field of one segment, looked up once for many points.
struct Place {
  Kind kind;
  bool left;
};
inline Place placeOf(const Skeleton& reference, int segment) {
  const std::string& name = reference.segments[segment].name;
  return {kindOf(name), sideSign(name) < 0};
}

template <class T>
const T* sideOf(const Place& place, const std::vector<T>& parameters) {
  return parameters.data() + kSideBegin + (place.left ? kSideCount : 0);
}

/// Right-side or midline field.
template <class T, class U>
Vector3<T> deformRight(const Skeleton& reference, Kind kind, const T* all, const T* side, const Vector3<U>& p) {
  const auto scaled = [&](const T& s) { return Vector3<T>{s * T(p.x()), s * T(p.y()), s * T(p.z())}; };
  switch (kind) {
    case Kind::Pelvis:
      return {all[kPelvisDepth] * T(p.x()), all[kPelvisHeight] * T(p.y()), all[kPelvisWidth] * T(p.z())};
    case Kind::Femur:
      return deformLimb(kFemur, side + kFemur, p);
    case Kind::Tibia:
      return deformLimb(kTibia, side + kTibia, p);
    case Kind::Humerus:
      return deformLimb(kHumerus, side + kHumerus, p);
    case Kind::Ulna:
      return deformLimb(kUlna, side + kUlna, p);
    case Kind::Radius: {  // with the ulna, whose axes it shares in supination
      const Vector3<U> head = reference.radii[0].p_UR.cast<U>();
      return deformLimb(kUlna, side + kUlna, Vector3<U>{head + p}) - deformLimb(kUlna, side + kUlna, head);
    }
    case Kind::Foot:
      return scaled(side[kFoot]);
    case Kind::Hand:
      return scaled(side[kHand]);
    case Kind::Patella:
      return scaled(side[kFemur + kDistalScale]);
    case Kind::Lumbar:
      return deformTrunk(all, false, p);
    case Kind::Thorax:
      return deformTrunk(all, true, p);
    case Kind::Neck:
      return {T(p.x()), all[kNeckElongation] * T(p.y()), T(p.z())};
    case Kind::Head:
      return scaled(all[kHeadScale]);
    case Kind::Scapula:
      return scaled(all[kTrunkExpansion]);
  }
  return {T(p.x()), T(p.y()), T(p.z())};
}

/// Field of either side.
template <class T, class U>
Vector3<T> deformAt(const Skeleton& reference, const std::vector<T>& parameters, const Place& place,
                    const Vector3<U>& p_B) {
  Vector3<U> right = p_B;
  if (place.left) right.z() = -right.z();
  Vector3<T> x = deformRight(reference, place.kind, parameters.data(), sideOf(place, parameters), right);
  if (place.left) x.z() = -x.z();
  return x;
}

/// How the deformation turns the frame of a joint at p on a right-side or midline segment.
template <class T>
Matrix3<T> jointRotationRight(Kind kind, const T* all, const T* side, const Eigen::Vector3d& p) {
  switch (kind) {
    case Kind::Femur:
      return limbDistalRotation(kFemur, side + kFemur);
    case Kind::Tibia:
      return limbDistalRotation(kTibia, side + kTibia);
    case Kind::Humerus:
      return limbDistalRotation(kHumerus, side + kHumerus);
    case Kind::Ulna:
      return limbDistalRotation(kUlna, side + kUlna);
    case Kind::Lumbar:
      return trunkRotation(all, false, p.y());
    case Kind::Thorax:
      return trunkRotation(all, true, p.y());
    default:
      return Matrix3<T>::Identity();
  }
}

/// How far the joint of the pelvis with `child` stands off its place on the pelvis; zero for all but the hips.
template <class T>
Vector3<T> hipShift(const Skeleton& reference, const std::vector<T>& parameters, int child) {
  const Place place = placeOf(reference, child);
  if (place.kind != Kind::Femur) return Vector3<T>::Zero();
  const T* hip = sideOf(place, parameters) + kHip;
  return {hip[2], hip[1], place.left ? T(-hip[0]) : hip[0]};
}

}  // namespace field

template <class T>
Vector3<T> deform(const Skeleton& reference, const std::vector<T>& parameters, int segment,
                  const Eigen::Vector3d& p_B) {
  return field::deformAt(reference, parameters, field::placeOf(reference, segment), p_B);
}

template <class T>
RigidTransformT<T> deformedJointFrame(const Skeleton& reference, const std::vector<T>& parameters, int joint) {
  const Joint& j = reference.joints[joint];
  RigidTransformT<T> X = j.X_PJ.cast<T>();
  if (j.parent < 0) return X;
  const field::Place place = field::placeOf(reference, j.parent);
  const Eigen::Vector3d p = j.X_PJ.translation();
  Matrix3<T> turn = field::jointRotationRight(place.kind, parameters.data(), field::sideOf(place, parameters),
                                              place.left ? mirrored(p) : p);
  if (place.left) {
    const Eigen::Matrix<T, 3, 1> flip{T(1), T(1), T(-1)};
    turn = Matrix3<T>{flip.asDiagonal() * turn * flip.asDiagonal()};
  }
  X.translation() = field::deformAt(reference, parameters, place, p);
  if (place.kind == field::Kind::Pelvis) X.translation() += field::hipShift(reference, parameters, j.child);
  X.linear() = turn * X.linear();
  return X;
}

}  // namespace sinew
