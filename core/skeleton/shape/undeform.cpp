#include <ceres/jet.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "core/optimization/bracketed_root.h"
#include "core/skeleton/shape/bone_field.h"

namespace sinew {
namespace {

using namespace field;
using Eigen::Vector3d;

struct ValueAndSlope {
  double value, slope;
};

/// The limb's parameters with zero derivatives, for jets of the axial coordinate.
template <class T>
std::array<T, 12> parametersAs(int bone, const double* limb) {
  std::array<T, 12> all{};
  const int count = bone == kFemur ? 12 : bone == kTibia ? 8 : 4;
  for (int i = 0; i < count; ++i) all[std::size_t(i)] = T(limb[i]);
  return all;
}

/// Takes back from x the bends that the place u has been given after torsion.
template <class T>
Vector3<T> withoutBends(int bone, const LimbReference& r, const T* limb, const T& u, Vector3<T> x) {
  const Vector3<T> distal = distalCenter(r, limb);
  if (bone == kFemur) {
    x = distal + turnedBack(kneeBend(limb, u), Vector3<T>{x - distal});
    return turnedBack(bowBend(limb, u), x);
  }
  if (bone == kTibia) {
    x = turnedBack(metaphysisBend(limb, u), x);
    return distal + turnedBack(ankleBend(limb, u), Vector3<T>{x - distal});
  }
  return x;
}

/// All but the stretch goes back in closed form once the axial coordinate u is known; u is the root of one monotone
/// function: where the stretch takes u, less the depth of x with the turns at u taken back. (The neck-shaft turn ends
/// where torsion begins, so that torsion, which keeps depths, need not be known.)
double axialCoordinate(int bone, const LimbReference& r, const double* limb, const Vector3d& x) {
  using Jet = ceres::Jet<double, 1>;
  const auto parameters = parametersAs<Jet>(bone, limb);
  const AxialRates<Jet> rates = axialRates(r, parameters.data());
  const auto imbalance = [&](double at) {
    const Jet u(at, 0);
    Vector3<Jet> back = withoutBends<Jet>(bone, r, parameters.data(), u, x.cast<Jet>());
    if (bone == kFemur) back = turnedBack(neckShaftBend(parameters.data(), u), back);
    const Jet gap = axialImage(r, rates, u) + back.y();
    return ValueAndSlope{gap.a, gap.v[0]};
  };
  double low = -r.length, high = 2 * r.length;
  while (imbalance(low).value > 0) low *= 2;
  while (imbalance(high).value < 0) high *= 2;
  return bracketedRoot(low, high, imbalance);
}

/// Before the neck was shifted: p = x - shift * weight(p), with the weight as the root of one monotone function.
Vector3d withoutNeckShift(const double* femur, const Vector3d& x) {
  using Jet = ceres::Jet<double, 1>;
  const Vector3d shift = neckShift(femur);
  if (shift.isZero(0)) return x;
  const auto imbalance = [&](double at) {
    const Jet w(at, 0);
    const Jet gap = w - neckWeight<Jet>(x.cast<Jet>() - w * shift.cast<Jet>());
    return ValueAndSlope{gap.a, gap.v[0]};
  };
  if (imbalance(0).value >= 0) return x;
  return x - bracketedRoot(0, 1, imbalance) * shift;
}

Vector3d undeformLimb(int bone, const double* limb, const Vector3d& p) {
  const LimbReference& r = limbReference(bone);
  const double u = axialCoordinate(bone, r, limb, p), cross = crossScale(r, limb, u);
  Vector3d x = withoutBends<double>(bone, r, limb, u, p);
  const Eigen::Vector2d c = cross * shaftAxis(r, u);
  const Vector3d axis{c.x(), 0, c.y()};
  x = axis + rotationAbout<double>(Vector3d::UnitY(), limb[kTorsion] * torsionShare(r, u)) * Vector3d{x - axis};
  if (bone == kFemur) x = turnedBack(neckShaftBend(limb, u), x);
  const Vector3d straight{x.x() / cross, -u, x.z() / cross};
  return bone == kFemur ? withoutNeckShift(limb, straight) : straight;
}

/// Inverse of hollowDepth().
double fullDepth(double depth, double curvature) {
  const double b = depth * curvature;
  if (b <= kFreeDepth) return depth;
  const double g = (b - kFreeDepth) / (1 - kFreeDepth);
  return (kFreeDepth + (1 - kFreeDepth) * g / (1 - g)) / curvature;
}

Vector3d undeformTrunk(const double* all, bool thorax, const Vector3d& p, const std::string& segment) {
  const double elongation = all[kTrunkElongation], expansion = all[kTrunkExpansion];
  const double curvature = trunkCurvature(all, thorax);
  double y = p.y() / elongation, depth = p.x();
  if (std::hypot(p.y() * curvature, 1 - p.x() * curvature) < 1e-6)
    throw InputError{{"undeform", segment, "a point that the bent trunk can reach", "the centre of its bend"}};
  if (std::abs(curvature) > 1e-3)  // the polar angle about the arc's centre
    y = std::atan2(p.y() * curvature, 1 - p.x() * curvature) / (curvature * elongation);
  // Two corrections bring a nearly straight trunk to machine precision, and the bent one from there to its depth.
  for (int i = 0; i < 4; ++i) {
    const double angle = trunkAngle(all, thorax, y);
    const Eigen::Vector2d off = Eigen::Vector2d{p.x(), p.y()} - arcPoint<double>(angle, elongation * y);
    depth = std::cos(angle) * off.x() - std::sin(angle) * off.y();
    y += (std::sin(angle) * off.x() + std::cos(angle) * off.y()) / (elongation * (1 - depth * curvature));
  }
  return {fullDepth(depth, curvature) / expansion, y, p.z() / expansion};
}

Vector3d undeformRight(const Skeleton& reference, const Place& place, const double* all, const double* side,
                       const Vector3d& p, const std::string& segment) {
  switch (place.kind) {
    case Kind::Femur:
      return undeformLimb(kFemur, side + kFemur, p);
    case Kind::Tibia:
      return undeformLimb(kTibia, side + kTibia, p);
    case Kind::Humerus:
      return undeformLimb(kHumerus, side + kHumerus, p);
    case Kind::Ulna:
      return undeformLimb(kUlna, side + kUlna, p);
    case Kind::Radius: {
      const Vector3d& head = reference.radii[0].p_UR;
      return undeformLimb(kUlna, side + kUlna, p + deformLimb(kUlna, side + kUlna, head)) - head;
    }
    case Kind::Lumbar:
      return undeformTrunk(all, false, p, segment);
    case Kind::Thorax:
      return undeformTrunk(all, true, p, segment);
    default: {  // the others scale along their axes: what becomes of the unit point says by how much
      const Vector3d scale = deformRight<double, double>(reference, place.kind, all, side, Vector3d::Ones());
      return p.cwiseQuotient(scale);
    }
  }
}

}  // namespace

Vector3d undeform(const Skeleton& reference, const std::vector<double>& parameters, int segment,
                  const Vector3d& p_B) {
  validate(shapeFromVector(parameters));
  const std::string& name = reference.segments[std::size_t(segment)].name;
  if (!p_B.allFinite()) throw InputError{{"undeform", name, "a finite point", "none"}};
  const Place place = placeOf(reference, segment);
  const Vector3d p = undeformRight(reference, place, parameters.data(), sideOf(place, parameters),
                                   place.left ? mirrored(p_B) : p_B, name);
  return place.left ? mirrored(p) : p;
}

}  // namespace sinew
