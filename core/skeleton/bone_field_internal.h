#pragma once
// Definitions of the templates of bone_field.h. Fields of the right side; the left side goes through the mirror.
#include <array>
#include <cmath>

#include "core/skeleton/bone_field.h"

namespace sinew {
namespace field {

// Places of the parameters in the flat list of shapeParameterNames().
constexpr int kPelvisWidth = 0, kPelvisHeight = 1, kPelvisDepth = 2, kTrunkElongation = 3, kTrunkExpansion = 4,
              kTrunkBend = 5, kNeckElongation = 6, kHeadScale = 7, kSideBegin = 8;
constexpr int kElongation = 0, kProximalScale = 1, kDistalScale = 2, kTorsion = 3, kNeckShaft = 4,
              kVarus = 5;  // of a limb bone
constexpr int kFemur = 0, kTibia = 6, kHumerus = 10, kUlna = 14, kFoot = 18, kHand = 19, kSideCount = 20;

/// C1 step from 0 at x <= 0 to 1 at x >= 1, and its integral from 0.
inline double step(double x) {
  return x <= 0 ? 0 : x >= 1 ? 1 : x * x * (3 - 2 * x);
}
inline double stepIntegral(double x) {
  return x <= 0 ? 0 : x >= 1 ? x - 0.5 : x * x * x * (1 - x / 2);
}

/// Reference proportions of a limb bone, along the axial coordinate u = -y from the proximal joint centre [m].
struct LimbReference {
  double length;                ///< to the distal joint centre
  double proximal_end;          ///< the proximal head reaches to here ...
  double distal_begin;          ///< ... and the distal head begins here
  double blend;                 ///< half width of the blends between head and shaft
  double neck_begin, neck_end;  ///< the neck-shaft angle fades out between (femur)
  double varus_begin;           ///< the varus angle sets in between here and distal_begin (femur)
  int axis_points;  ///< shaft axis as (u, x, z); zero in the distal head, so that torsion turns it rigidly
  std::array<Eigen::Vector3d, 6> axis;
};

inline const LimbReference& limbReference(int bone) {
  static const LimbReference femur{0.422,
                                   0.100,
                                   0.352,
                                   0.020,
                                   0.030,
                                   0.100,
                                   0.290,
                                   6,
                                   {Eigen::Vector3d{0.0, -0.006, 0.041},
                                    {0.080, -0.006, 0.041},
                                    {0.200, 0.003, 0.026},
                                    {0.300, 0.002, 0.012},
                                    {0.345, 0.000, 0.000},
                                    {0.422, 0.000, 0.000}}};
  static const LimbReference tibia{0.430,
                                   0.090,
                                   0.370,
                                   0.020,
                                   0,
                                   0,
                                   0,
                                   5,
                                   {Eigen::Vector3d{0.0, 0.003, 0.0},
                                    {0.120, 0.002, 0.000},
                                    {0.250, -0.002, -0.002},
                                    {0.365, 0.000, 0.000},
                                    {0.430, 0.000, 0.000},
                                    {0, 0, 0}}};
  static const LimbReference humerus{0.290,
                                     0.060,
                                     0.240,
                                     0.015,
                                     0,
                                     0,
                                     0,
                                     4,
                                     {Eigen::Vector3d{0.0, 0.003, 0.003},
                                      {0.200, 0.003, 0.003},
                                      {0.235, 0.000, 0.000},
                                      {0.290, 0.000, 0.000},
                                      {0, 0, 0},
                                      {0, 0, 0}}};
  static const LimbReference ulna{
      0.258, 0.060, 0.208,
      0.015, 0,     0,
      0,     2,     {Eigen::Vector3d{0.0, 0.0, 0.0}, {0.258, 0.0, 0.0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  return bone == kFemur ? femur : bone == kTibia ? tibia : bone == kHumerus ? humerus : ulna;
}

/// Shaft axis at u: x and z, C1 (smooth steps between the tabulated points).
inline Eigen::Vector2d shaftAxis(const LimbReference& r, double u) {
  for (int i = 0; i + 1 < r.axis_points; ++i) {
    const auto& a = r.axis[i];
    const auto& b = r.axis[i + 1];
    if (u < b.x() || i + 2 == r.axis_points) {
      const double t = step((u - a.x()) / (b.x() - a.x()));
      return {a.y() + t * (b.y() - a.y()), a.z() + t * (b.z() - a.z())};
    }
  }
  return Eigen::Vector2d::Zero();
}

/// Weights of proximal head, shaft and distal head at u (sum 1, C1), and their integrals from 0.
struct AxialWeights {
  double proximal, shaft, distal;
};
inline AxialWeights weightsAt(const LimbReference& r, double u) {
  const double p = step((u - r.proximal_end) / (2 * r.blend) + 0.5);
  const double d = step((u - r.distal_begin) / (2 * r.blend) + 0.5);
  return {1 - p, p - d, d};
}
inline AxialWeights weightIntegrals(const LimbReference& r, double u) {
  const double p = 2 * r.blend * stepIntegral((u - r.proximal_end) / (2 * r.blend) + 0.5);
  const double d = 2 * r.blend * stepIntegral((u - r.distal_begin) / (2 * r.blend) + 0.5);
  return {u - p, p - d, d};
}

/// Stretch rate of the shaft: what is left of the wanted length after both heads. Must be positive.
template <class T>
T shaftStretch(const LimbReference& r, const T* limb) {
  const AxialWeights i = weightIntegrals(r, r.length);
  return (limb[kElongation] * T(r.length) - limb[kProximalScale] * T(i.proximal) - limb[kDistalScale] * T(i.distal)) /
         T(i.shaft);
}

template <class T>
Matrix3<T> limbDistalRotation(int bone, const T* limb) {
  const Matrix3<T> torsion = rotationAbout<T>(-Eigen::Vector3d::UnitY(), limb[kTorsion]);
  return bone == kFemur ? Matrix3<T>{rotationAbout<T>(Eigen::Vector3d::UnitX(), limb[kVarus]) * torsion} : torsion;
}

/// Field of a limb bone, right side: stretch and scale, then neck-shaft turn about the head centre, torsion about the
/// shaft axis, varus about the distal joint centre.
template <class T>
Vector3<T> deformLimb(int bone, const T* limb, const Eigen::Vector3d& p) {
  const LimbReference& r = limbReference(bone);
  const double u = -p.y();
  const AxialWeights w = weightsAt(r, u), i = weightIntegrals(r, u);
  const T mean = (limb[kProximalScale] + limb[kDistalScale]) * T(0.5);
  const T cross = limb[kProximalScale] * T(w.proximal) + mean * T(w.shaft) + limb[kDistalScale] * T(w.distal);
  const T axial =
      limb[kProximalScale] * T(i.proximal) + shaftStretch(r, limb) * T(i.shaft) + limb[kDistalScale] * T(i.distal);
  Vector3<T> x{cross * T(p.x()), -axial, cross * T(p.z())};
  if (bone == kFemur) {
    const double neck = 1 - step((u - r.neck_begin) / (r.neck_end - r.neck_begin));
    if (neck > 0) x = rotationAbout<T>(Eigen::Vector3d::UnitX(), limb[kNeckShaft] * T(neck)) * x;
  }
  const double turn = step((u - r.proximal_end) / (r.distal_begin - r.proximal_end));
  if (turn > 0) {
    const Eigen::Vector2d c = shaftAxis(r, u);
    const Vector3<T> axis{cross * T(c.x()), T(0), cross * T(c.y())};
    x = axis + rotationAbout<T>(-Eigen::Vector3d::UnitY(), limb[kTorsion] * T(turn)) * (x - axis);
  }
  if (bone == kFemur) {
    const double bent = step((u - r.varus_begin) / (r.distal_begin - r.varus_begin));
    const Vector3<T> knee{T(0), -limb[kElongation] * T(r.length), T(0)};
    if (bent > 0) x = knee + rotationAbout<T>(Eigen::Vector3d::UnitX(), limb[kVarus] * T(bent)) * (x - knee);
  }
  return x;
}

/// Trunk segments: elongated along Y, expanded across, bent on a circular arc; half the bend over each segment.
inline double trunkLength(bool thorax) {
  return thorax ? 0.270 : 0.185;
}

template <class T>
Matrix3<T> trunkRotation(const T* parameters, bool thorax, double y) {
  return rotationAbout<T>(-Eigen::Vector3d::UnitZ(), parameters[kTrunkBend] * T(0.5 * y / trunkLength(thorax)));
}

template <class T>
Vector3<T> deformTrunk(const T* parameters, bool thorax, const Eigen::Vector3d& p) {
  using std::cos, std::sin;
  const T e = parameters[kTrunkElongation];
  const T angle = parameters[kTrunkBend] * T(0.5 * p.y() / trunkLength(thorax));
  const T arc = e * T(p.y());
  // (1 - cos a) / a and sin(a) / a, by series near the straight trunk.
  T forward = angle * T(0.5), upward = T(1) - angle * angle / T(6);
  if (angle > T(1e-4) || angle < T(-1e-4)) {
    forward = (T(1) - cos(angle)) / angle;
    upward = sin(angle) / angle;
  }
  const T s = parameters[kTrunkExpansion];
  return Vector3<T>{arc * forward, arc * upward, T(0)} +
         trunkRotation(parameters, thorax, p.y()) * Vector3<T>{s * T(p.x()), T(0), s * T(p.z())};
}

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

/// Right-side or midline field.
template <class T>
Vector3<T> deformRight(const Skeleton& reference, Kind kind, const T* all, const T* side, const Eigen::Vector3d& p) {
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
      const Eigen::Vector3d& head = reference.radii[0].p_UR;
      return deformLimb(kUlna, side + kUlna, Eigen::Vector3d{head + p}) - deformLimb(kUlna, side + kUlna, head);
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
  return p.cast<T>();
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

}  // namespace field

template <class T>
Vector3<T> deform(const Skeleton& reference, const std::vector<T>& parameters, int segment,
                  const Eigen::Vector3d& p_B) {
  const std::string& name = reference.segments[segment].name;
  const bool left = sideSign(name) < 0;
  const T* side = &parameters[field::kSideBegin + (left ? field::kSideCount : 0)];
  const Eigen::Vector3d right = left ? mirrored(p_B) : p_B;
  Vector3<T> x = field::deformRight(reference, field::kindOf(name), parameters.data(), side, right);
  if (left) x.z() = -x.z();
  return x;
}

template <class T>
RigidTransformT<T> deformedJointFrame(const Skeleton& reference, const std::vector<T>& parameters, int joint) {
  const Joint& j = reference.joints[joint];
  RigidTransformT<T> X = j.X_PJ.cast<T>();
  if (j.parent < 0) return X;
  const std::string& name = reference.segments[j.parent].name;
  const bool left = sideSign(name) < 0;
  const T* side = &parameters[field::kSideBegin + (left ? field::kSideCount : 0)];
  const Eigen::Vector3d p = j.X_PJ.translation();
  Matrix3<T> turn = field::jointRotationRight(field::kindOf(name), parameters.data(), side, left ? mirrored(p) : p);
  if (left) {
    const Eigen::Matrix<T, 3, 1> flip{T(1), T(1), T(-1)};
    turn = Matrix3<T>{flip.asDiagonal() * turn * flip.asDiagonal()};
  }
  X.translation() = deform(reference, parameters, j.parent, p);
  X.linear() = turn * X.linear();
  return X;
}

}  // namespace sinew
