#pragma once
// Field of a limb bone. T: scalar of the parameters and of the result; U: scalar of the point, double or T.
#include <array>

#include "core/geometry/rigid_transform.h"

namespace sinew::field {

// Places of the parameters of one side in the flat list of shapeParameterNames(), and of one limb bone in them.
constexpr int kElongation = 0, kProximalScale = 1, kDistalScale = 2, kTorsion = 3;
constexpr int kVarus = 4, kProcurvatum = 5;  // femur and tibia
constexpr int kNeckShaft = 6, kNeckLength = 7, kNeckVarus = 8, kNeckRetroversion = 9, kBowFrontal = 10,
              kBowSagittal = 11;                         // femur
constexpr int kDistalVarus = 6, kDistalProcurvatum = 7;  // tibia
constexpr int kFemur = 0, kTibia = 12, kHumerus = 20, kUlna = 24, kFoot = 28, kHand = 29, kHip = 30, kSideCount = 33;

/// C1 step from 0 at x <= 0 to 1 at x >= 1, and its integral from 0.
template <class U>
U step(const U& x) {
  return x <= U(0) ? U(0) : x >= U(1) ? U(1) : x * x * (U(3) - U(2) * x);
}
template <class U>
U stepIntegral(const U& x) {
  return x <= U(0) ? U(0) : x >= U(1) ? x - U(0.5) : x * x * x * (U(1) - x * U(0.5));
}

/// Reference proportions of a limb bone, along the axial coordinate u = -y from the proximal joint centre [m].
struct LimbReference {
  double length;        ///< to the distal joint centre
  double proximal_end;  ///< the proximal head reaches to here ...
  double distal_begin;  ///< ... and the distal head begins here
  double blend;         ///< half width of the blends between head and shaft
  int axis_points;      ///< shaft axis as (u, x, z); zero in the distal head, so that torsion turns it rigidly
  std::array<Eigen::Vector3d, 6> axis;
};

inline const LimbReference& limbReference(int bone) {
  static const LimbReference femur{0.422,
                                   0.100,
                                   0.352,
                                   0.020,
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
                                     4,
                                     {Eigen::Vector3d{0.0, 0.003, 0.003},
                                      {0.200, 0.003, 0.003},
                                      {0.235, 0.000, 0.000},
                                      {0.290, 0.000, 0.000},
                                      {0, 0, 0},
                                      {0, 0, 0}}};
  static const LimbReference ulna{
      0.258, 0.060, 0.208,
      0.015, 2,     {Eigen::Vector3d{0.0, 0.0, 0.0}, {0.258, 0.0, 0.0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  return bone == kFemur ? femur : bone == kTibia ? tibia : bone == kHumerus ? humerus : ulna;
}

/// Shaft axis at u: x and z, C1 (smooth steps between the tabulated points).
template <class U>
Eigen::Matrix<U, 2, 1> shaftAxis(const LimbReference& r, const U& u) {
  for (int i = 0; i + 1 < r.axis_points; ++i) {
    const auto& a = r.axis[i];
    const auto& b = r.axis[i + 1];
    if (u < U(b.x()) || i + 2 == r.axis_points) {
      const U t = step<U>((u - U(a.x())) / U(b.x() - a.x()));
      return {U(a.y()) + t * U(b.y() - a.y()), U(a.z()) + t * U(b.z() - a.z())};
    }
  }
  return Eigen::Matrix<U, 2, 1>::Zero();
}

/// Weights of proximal head, shaft and distal head at u (sum 1, C1), and their integrals from 0.
template <class U>
struct AxialWeights {
  U proximal, shaft, distal;
};
template <class U>
AxialWeights<U> weightsAt(const LimbReference& r, const U& u) {
  const U p = step<U>((u - U(r.proximal_end)) / U(2 * r.blend) + U(0.5));
  const U d = step<U>((u - U(r.distal_begin)) / U(2 * r.blend) + U(0.5));
  return {U(1) - p, p - d, d};
}
template <class U>
AxialWeights<U> weightIntegrals(const LimbReference& r, const U& u) {
  const U p = U(2 * r.blend) * stepIntegral<U>((u - U(r.proximal_end)) / U(2 * r.blend) + U(0.5));
  const U d = U(2 * r.blend) * stepIntegral<U>((u - U(r.distal_begin)) / U(2 * r.blend) + U(0.5));
  return {u - p, p - d, d};
}

/// Stretch of proximal head, shaft and distal head along the axis.
template <class T>
struct AxialRates {
  T proximal, shaft, distal;
};

/// The heads keep their scale along the axis and the shaft takes what is left of the wanted length, while that is at
/// least half of its own at the heads' mean scale. A shorter bone presses its heads together too (share < 1): share
/// and shaft both go to zero with the length, monotonically, and stay positive. The joint distance is the wanted one
/// in every case.
template <class T>
AxialRates<T> axialRates(const LimbReference& r, const T* limb) {
  constexpr double kFreeShaft = 0.5;
  const AxialWeights<double> whole = weightIntegrals(r, r.length);
  const T length = limb[kElongation] * T(r.length);
  const T heads = limb[kProximalScale] * T(whole.proximal) + limb[kDistalScale] * T(whole.distal);
  const T shaft = (limb[kProximalScale] + limb[kDistalScale]) * T(0.5 * whole.shaft);
  const T free = heads + T(kFreeShaft) * shaft;
  T share(1);
  if (length < free) {
    const T z = length / free;
    share = z * (T(1.25) + z * (T(0.5) - T(0.75) * z));  // 0 and slope 1.25 at 0, 1 and slope 0 at 1
  }
  return {share * limb[kProximalScale], (length - share * heads) / T(whole.shaft), share * limb[kDistalScale]};
}

/// Image of the axial coordinate u, positive downwards.
template <class T, class U>
T axialImage(const LimbReference& r, const AxialRates<T>& rates, const U& u) {
  const AxialWeights<U> i = weightIntegrals(r, u);
  return rates.proximal * T(i.proximal) + rates.shaft * T(i.shaft) + rates.distal * T(i.distal);
}

/// Size of the cross-section at u.
template <class T, class U>
T crossScale(const LimbReference& r, const T* limb, const U& u) {
  const AxialWeights<U> w = weightsAt(r, u);
  const T mean = (limb[kProximalScale] + limb[kDistalScale]) * T(0.5);
  return limb[kProximalScale] * T(w.proximal) + mean * T(w.shaft) + limb[kDistalScale] * T(w.distal);
}

/// Share of the torsion at u.
template <class U>
U torsionShare(const LimbReference& r, const U& u) {
  return step<U>((u - U(r.proximal_end)) / U(r.distal_begin - r.proximal_end));
}

template <class T>
Vector3<T> distalCenter(const LimbReference& r, const T* limb) {
  return {T(0), -limb[kElongation] * T(r.length), T(0)};
}

}  // namespace sinew::field
