#include <ceres/jet.h>

#include <cmath>

#include "core/error.h"
#include "core/optimization/bracketed_root.h"
#include "core/skeleton/shape/bone_field.h"

namespace sinew {
namespace {

using namespace field;
using Eigen::Vector3d;

Vector3d turned(const Vector3d& axis, double angle_rad, const Vector3d& x) {
  return rotationAbout<double>(axis, angle_rad) * x;
}

struct ValueAndSlope {
  double value, slope;
};

/// Takes the varus turn of the place u back from x (femur).
template <class T>
Vector3<T> withoutVarus(const LimbReference& r, const double* limb, const T& u, const Vector3d& x) {
  const Vector3d knee = distalCenter(r, limb);
  const T angle = -limb[kVarus] * varusShare(r, u);
  return knee.cast<T>() + rotationAbout<T>(Vector3d::UnitX(), angle) * Vector3d{x - knee}.cast<T>();
}

/// All but the stretch goes back in closed form once the axial coordinate u is known; u is the root of one monotone
/// function: where the stretch takes u, less the depth of x with the femur's own turns at u taken back.
double axialCoordinate(int bone, const LimbReference& r, const double* limb, const Vector3d& x) {
  using Jet = ceres::Jet<double, 1>;
  const AxialRates<double> rates = axialRates(r, limb);
  const AxialRates<Jet> jets{Jet(rates.proximal), Jet(rates.shaft), Jet(rates.distal)};
  const auto imbalance = [&](double at) {
    const Jet u(at, 0);
    Vector3<Jet> back = x.cast<Jet>();
    if (bone == kFemur) {
      back = withoutVarus(r, limb, u, x);
      back = rotationAbout<Jet>(Vector3d::UnitX(), -limb[kNeckShaft] * neckShare(r, u)) * back;
    }
    const Jet gap = axialImage(r, jets, u) + back.y();
    return ValueAndSlope{gap.a, gap.v[0]};
  };
  double low = -r.length, high = 2 * r.length;
  while (imbalance(low).value > 0) low *= 2;
  while (imbalance(high).value < 0) high *= 2;
  return bracketedRoot(low, high, imbalance);
}

Vector3d undeformLimb(int bone, const double* limb, const Vector3d& p) {
  const LimbReference& r = limbReference(bone);
  const double u = axialCoordinate(bone, r, limb, p), cross = crossScale(r, limb, u);
  Vector3d x = bone == kFemur ? withoutVarus(r, limb, u, p) : p;
  const Eigen::Vector2d c = cross * shaftAxis(r, u);
  const Vector3d axis{c.x(), 0, c.y()};
  x = axis + turned(Vector3d::UnitY(), limb[kTorsion] * torsionShare(r, u), x - axis);
  if (bone == kFemur) x = turned(Vector3d::UnitX(), -limb[kNeckShaft] * neckShare(r, u), x);
  return {x.x() / cross, -u, x.z() / cross};
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
