#include "core/skeleton/bone_field.h"

#include <string_view>

#include "core/error.h"

namespace sinew {
namespace field {

Kind kindOf(const std::string& segment_name) {
  constexpr std::pair<std::string_view, Kind> kKinds[] = {
      {"pelvis", Kind::Pelvis},   {"femur", Kind::Femur},     {"tibia", Kind::Tibia}, {"foot", Kind::Foot},
      {"lumbar", Kind::Lumbar},   {"thorax", Kind::Thorax},   {"neck", Kind::Neck},   {"head", Kind::Head},
      {"scapula", Kind::Scapula}, {"humerus", Kind::Humerus}, {"ulna", Kind::Ulna},   {"hand", Kind::Hand},
      {"patella", Kind::Patella}, {"radius", Kind::Radius}};
  const std::string_view base = withoutSide(segment_name);
  for (const auto& [name, kind] : kKinds)
    if (name == base) return kind;
  throw InputError{{"shape", segment_name, "a segment with a deformation field", "none"}};
}

}  // namespace field

namespace {

/// Size ratios along X, Y, Z that stand for the deformation in mass and inertia.
Eigen::Vector3d meanScale(const std::vector<double>& all, const std::string& segment) {
  using namespace field;
  const double* side = &all[kSideBegin + (sideSign(segment) < 0 ? kSideCount : 0)];
  const auto limb = [&](int bone) -> Eigen::Vector3d {
    const double across = (side[bone + kProximalScale] + side[bone + kDistalScale]) / 2;
    return {across, side[bone + kElongation], across};
  };
  switch (kindOf(segment)) {
    case Kind::Pelvis:
      return {all[kPelvisDepth], all[kPelvisHeight], all[kPelvisWidth]};
    case Kind::Femur:
      return limb(kFemur);
    case Kind::Tibia:
      return limb(kTibia);
    case Kind::Humerus:
      return limb(kHumerus);
    case Kind::Ulna:
      return limb(kUlna);
    case Kind::Lumbar:
    case Kind::Thorax:
      return {all[kTrunkExpansion], all[kTrunkElongation], all[kTrunkExpansion]};
    case Kind::Neck:
      return {1, all[kNeckElongation], 1};
    case Kind::Head:
      return Eigen::Vector3d::Constant(all[kHeadScale]);
    case Kind::Scapula:
      return Eigen::Vector3d::Constant(all[kTrunkExpansion]);
    case Kind::Foot:
      return Eigen::Vector3d::Constant(side[kFoot]);
    case Kind::Hand:
      return Eigen::Vector3d::Constant(side[kHand]);
    default:
      return Eigen::Vector3d::Ones();  // driven bodies carry no mass
  }
}

/// Mass with the volume; second moments of mass with the squared size along each axis.
void scaleInertia(Segment& segment, const Eigen::Vector3d& scale) {
  const double ratio = scale.prod();
  segment.mass_kg *= ratio;
  const Eigen::Vector3d inertia = segment.inertia_B_kgm2.diagonal();
  const Eigen::Vector3d moments =
      ((Eigen::Vector3d::Constant(inertia.sum() / 2) - inertia).array() * scale.array().square() * ratio).matrix();
  segment.inertia_B_kgm2 = (Eigen::Vector3d::Constant(moments.sum()) - moments).asDiagonal();
}

void requireUprightShafts(const ShapeParameters& shape) {
  for (int i = 0; i < 2; ++i) {
    const SideShape& s = shape.sides[i];
    const std::pair<const char*, const LimbBoneShape*> limbs[] = {
        {"femur", &s.femur}, {"tibia", &s.tibia}, {"humerus", &s.humerus}, {"ulna", &s.ulna}};
    const int bones[] = {field::kFemur, field::kTibia, field::kHumerus, field::kUlna};
    for (int b = 0; b < 4; ++b) {
      const LimbBoneShape& limb = *limbs[b].second;
      const double p[] = {limb.elongation, limb.proximal_scale, limb.distal_scale};
      const double stretch = field::shaftStretch(field::limbReference(bones[b]), p);
      constexpr double kLeastStretch = 0.1;  // a shaft of a tenth of its length is no bone any more
      if (stretch < kLeastStretch)
        throw InputError{{"shape", std::string{limbs[b].first} + (i == 0 ? "_r" : "_l") + ".elongation",
                          "a bone longer than its two heads; reduce proximal_scale and distal_scale with it",
                          std::to_string(limb.elongation)}};
    }
  }
}

}  // namespace

Skeleton deformedSkeleton(const Skeleton& reference, const ShapeParameters& shape) {
  validate(shape);
  requireUprightShafts(shape);
  const std::vector<double> all = toVector(shape);
  Skeleton s = reference;
  for (int j = 0; j < static_cast<int>(s.joints.size()); ++j)
    s.joints[j].X_PJ = deformedJointFrame(reference, all, j);
  for (auto& landmark : s.landmarks) landmark.p_BL = deform(reference, all, landmark.segment, landmark.p_BL);
  for (int i = 0; i < s.movingSegmentCount(); ++i) {
    s.segments[i].p_BCom = deform(reference, all, i, s.segments[i].p_BCom);
    scaleInertia(s.segments[i], meanScale(all, s.segments[i].name));
  }
  for (int side = 0; side < 2; ++side) {
    PatellaDriver& patella = s.patellae[side];
    const Joint& knee = s.joints[s.coordinates[patella.knee_coordinate].joint];
    patella.p_FK = knee.X_PJ.translation();
    patella.R_FK = knee.X_PJ.linear();
    patella.radius_m = reference.patellae[side].radius_m * shape.sides[side].femur.distal_scale;
    // The forearm axis keeps the reference's direction in the joint's coordinates; the head moves with the ulna.
    RadiusDriver& radius = s.radii[side];
    radius.p_UR = deform(reference, all, radius.ulna, radius.p_UR);
  }
  return s;
}

}  // namespace sinew
