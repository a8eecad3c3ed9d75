#pragma once
// Bends of femur and tibia: turns about a joint centre that set in over a stretch of the shaft, and the femoral neck.
// T: scalar of the parameters and of the result; U: scalar of the point, double or T. Right side.
#include <type_traits>

#include "core/skeleton/shape/limb_field_internal.h"

namespace sinew::field {

// ---- turns about a joint centre --------------------------------------------------------------------------------

/// A turn in the frontal plane (about X, positive takes the distal end inwards) after one in the sagittal plane
/// (about -Z, positive takes the distal end backwards).
template <class T>
struct Bend {
  T frontal, sagittal;
};

template <class T>
Vector3<T> turned(const Bend<T>& bend, const Vector3<T>& v) {
  using std::cos, std::sin;
  const T cs = cos(bend.sagittal), ss = sin(bend.sagittal), cf = cos(bend.frontal), sf = sin(bend.frontal);
  const T x = cs * v.x() + ss * v.y(), y = cs * v.y() - ss * v.x();
  return {x, cf * y - sf * v.z(), sf * y + cf * v.z()};
}
/// `x` turned about `center`. Exactly x where there is no bend: the reference stays what it is to the last bit.
template <class T>
Vector3<T> turnedAbout(const Vector3<T>& center, const Bend<T>& bend, const Vector3<T>& x) {
  if constexpr (std::is_same_v<T, double>)
    if (bend.frontal == 0 && bend.sagittal == 0) return x;
  return center + turned(bend, Vector3<T>{x - center});
}
template <class T>
Vector3<T> turnedBack(const Bend<T>& bend, const Vector3<T>& v) {
  using std::cos, std::sin;
  const T cs = cos(bend.sagittal), ss = sin(bend.sagittal), cf = cos(bend.frontal), sf = sin(bend.frontal);
  const T y = cf * v.y() + sf * v.z(), z = cf * v.z() - sf * v.y();
  return {cs * v.x() - ss * y, cs * y + ss * v.x(), z};
}
template <class T>
Matrix3<T> turnOf(const Bend<T>& bend) {
  Matrix3<T> R;
  for (int i = 0; i < 3; ++i) R.col(i) = turned(bend, Vector3<T>{Eigen::Vector3d::Unit(i).cast<T>()});
  return R;
}

/// Where along the bone [m, reference] a bend sets in, and from where on it is whole.
struct Stretch {
  double begin, end;
};
constexpr Stretch kSubtrochanteric{0.030, 0.100}, kFemoralShaft{0.100, 0.330}, kSupracondylar{0.290, 0.352};
constexpr Stretch kTibialMetaphysis{0.040, 0.120}, kSupramalleolar{0.300, 0.370};

template <class U>
U shareOf(const Stretch& s, const U& u) {
  return step<U>((u - U(s.begin)) / U(s.end - s.begin));
}

/// Turn of the neck-shaft angle at u, about the head's centre: whole in the neck, gone at the end of the proximal
/// head.
template <class T, class U>
Bend<T> neckShaftBend(const T* femur, const U& u) {
  return {femur[kNeckShaft] * T(U(1) - shareOf(kSubtrochanteric, u)), T(0)};
}
/// Upper half of the femoral bow at u, about the head's centre.
template <class T, class U>
Bend<T> bowBend(const T* femur, const U& u) {
  const T share(U(0.5) * (shareOf(kFemoralShaft, u) - U(1)));
  return {femur[kBowFrontal] * share, femur[kBowSagittal] * share};
}
/// Turn at u about the knee: the femur's own bends above it, and the lower half of the bow.
template <class T, class U>
Bend<T> kneeBend(const T* femur, const U& u) {
  const T above(shareOf(kSupracondylar, u)), half(U(0.5) * shareOf(kFemoralShaft, u));
  return {femur[kVarus] * above + femur[kBowFrontal] * half,
          femur[kProcurvatum] * above + femur[kBowSagittal] * half};
}
/// Turns of the tibia at u: of what lies below the metaphysis about the knee, of what lies above the ankle about the
/// ankle.
template <class T, class U>
Bend<T> metaphysisBend(const T* tibia, const U& u) {
  const T share(shareOf(kTibialMetaphysis, u));
  return {tibia[kVarus] * share, tibia[kProcurvatum] * share};
}
template <class T, class U>
Bend<T> ankleBend(const T* tibia, const U& u) {
  const T share(shareOf(kSupramalleolar, u));
  return {tibia[kDistalVarus] * share, tibia[kDistalProcurvatum] * share};
}

/// How the frame of the distal joint turns.
template <class T>
Matrix3<T> limbDistalRotation(int bone, const T* limb) {
  const Matrix3<T> torsion = rotationAbout<T>(-Eigen::Vector3d::UnitY(), limb[kTorsion]);
  const double end = limbReference(bone).length;
  if (bone == kFemur) return turnOf(kneeBend<T, double>(limb, end)) * torsion;
  if (bone == kTibia)
    return turnOf(metaphysisBend<T, double>(limb, end)) * turnOf(ankleBend<T, double>(limb, end)) * torsion;
  return torsion;
}

// ---- the femoral neck ------------------------------------------------------------------------------------------

/// From the head's centre to the neck's base [m, reference], as the landmarks of the reference have it.
inline const Eigen::Vector3d& neckVector() {
  static const Eigen::Vector3d p_HN{-0.009, -0.040, 0.0425};
  return p_HN;
}
constexpr double kNeckLength_m = 0.05905294234837076;  // its norm
constexpr double kNeckBlend_m = 0.046;  // along the neck from the head's centre: what lies farther moves whole

/// How the base of the neck moves against the head [m, reference] when the neck is longer and bent.
template <class T>
Vector3<T> neckShift(const T* femur) {
  using std::cos, std::sin;
  const Eigen::Vector3d& n = neckVector();
  const T cr = cos(femur[kNeckRetroversion]), sr = sin(femur[kNeckRetroversion]);
  const T cv = cos(femur[kNeckVarus]), sv = sin(femur[kNeckVarus]);
  const T x = cr * T(n.x()) + sr * T(n.z()), z = cr * T(n.z()) - sr * T(n.x()), y(n.y());
  const Vector3<T> bent{x, cv * y + sv * z, cv * z - sv * y};
  const T longer = femur[kNeckLength] / (femur[kProximalScale] * T(kNeckLength_m));
  return {bent.x() - T(n.x()) + longer * bent.x(), bent.y() - T(n.y()) + longer * bent.y(),
          bent.z() - T(n.z()) + longer * bent.z()};
}

/// Share of that shift at p: 0 at the head's centre, 1 from the base of the neck on, 0 again at the lower shaft, so
/// that both joint centres stay.
template <class U>
U neckWeight(const Vector3<U>& p) {
  const Eigen::Vector3d& n = neckVector();
  const U along = (U(n.x()) * p.x() + U(n.y()) * p.y() + U(n.z()) * p.z()) / U(kNeckLength_m);
  const U weight = step<U>(along / U(kNeckBlend_m));
  return weight > U(0) ? U(weight * (U(1) - shareOf(kFemoralShaft, U(-p.y())))) : U(0);
}

// ---- the field of a limb bone ----------------------------------------------------------------------------------

/// Without the neck: stretch and scale, neck-shaft turn about the head's centre, torsion about the shaft axis, then
/// the bends.
template <class T, class U>
Vector3<T> deformShaft(int bone, const T* limb, const Vector3<U>& p) {
  const LimbReference& r = limbReference(bone);
  const U u = -p.y();
  const T cross = crossScale(r, limb, u);
  Vector3<T> x{cross * T(p.x()), -axialImage(r, axialRates(r, limb), u), cross * T(p.z())};
  if (bone == kFemur && u < U(kSubtrochanteric.end)) x = turned(neckShaftBend(limb, u), x);
  const U turn = torsionShare(r, u);
  if (turn > U(0)) {
    const Eigen::Matrix<U, 2, 1> c = shaftAxis(r, u);
    const Vector3<T> axis{cross * T(c.x()), T(0), cross * T(c.y())};
    x = axis + rotationAbout<T>(-Eigen::Vector3d::UnitY(), limb[kTorsion] * T(turn)) * (x - axis);
  }
  if (bone == kFemur) {
    if (u < U(kFemoralShaft.end)) x = turned(bowBend(limb, u), x);
    if (u > U(kFemoralShaft.begin)) x = turnedAbout(distalCenter(r, limb), kneeBend(limb, u), x);
  }
  if (bone == kTibia) {
    if (u > U(kSupramalleolar.begin)) x = turnedAbout(distalCenter(r, limb), ankleBend(limb, u), x);
    if (u > U(kTibialMetaphysis.begin)) x = turned(metaphysisBend(limb, u), x);
  }
  return x;
}

/// Field of a limb bone, right side: the femoral neck first, in the reference's dimensions, then the rest.
template <class T, class U>
Vector3<T> deformLimb(int bone, const T* limb, const Vector3<U>& p) {
  if (bone == kFemur)
    if (const U weight = neckWeight(p); weight > U(0)) {
      const Vector3<T> shift = neckShift(limb);
      const T w(weight);
      return deformShaft<T, T>(bone, limb,
                               {T(p.x()) + w * shift.x(), T(p.y()) + w * shift.y(), T(p.z()) + w * shift.z()});
    }
  return deformShaft<T, U>(bone, limb, p);
}

}  // namespace sinew::field
