#include "core/skeleton/shape/bone_field.h"

#include <numbers>
#include <string_view>

#include "core/error.h"
#include "core/skeleton/shape/deformed_inertia.h"
#include "core/skeleton/shape/field_jets_internal.h"

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

/// A bone below this elongation whose heads are larger still is no bone any more. Larger heads on a longer bone are
/// odd, but a shape.
constexpr double kLeastElongation = 0.38;

void requireLongerThanHeads(const std::string& bone, const LimbBoneShape& limb) {
  const double heads = (limb.proximal_scale + limb.distal_scale) / 2;
  if (limb.elongation < kLeastElongation && limb.elongation < kLeastElongation * heads)
    throw InputError{{"shape", bone + ".elongation",
                      "a bone longer than its two heads; reduce proximal_scale and distal_scale with it",
                      std::to_string(limb.elongation)}};
}

/// The two turns of the femur in the frontal plane bring points at its sides together. Torsion only shears, and the
/// other fields cannot fold.
void requireUnfolded(const Skeleton& reference, const ShapeParameters& shape, int side) {
  const LimbBoneShape& femur = shape.sides[std::size_t(side)].femur;
  if (femur.neck_shaft_rad == 0 && femur.varus_rad == 0) return;
  ShapeParameters straight = shape;
  straight.sides[std::size_t(side)].femur.neck_shaft_rad = straight.sides[std::size_t(side)].femur.varus_rad = 0;
  const auto bent_jets = field::pointJets(toVector(shape)), straight_jets = field::pointJets(toVector(straight));
  const field::Place place{field::Kind::Femur, side == 1};
  const auto check = [&](double u, double z, const char* parameter, double angle_rad) {
    constexpr double kLeastShare = 0.1;  // of the volume that it has without the two angles
    for (const double x : {-0.03, 0.03}) {
      const Eigen::Vector3d p{x, -u, side == 0 ? z : -z};
      if (field::jacobianAt(reference, bent_jets, place, p).d_point.determinant() <
          kLeastShare * field::jacobianAt(reference, straight_jets, place, p).d_point.determinant())
        throw InputError{{"shape", std::string{side == 0 ? "femur_r." : "femur_l."} + parameter,
                          "an angle that does not fold the bone, given its elongation",
                          std::to_string(angle_rad * 180 / std::numbers::pi) + " deg"}};
    }
  };
  const field::LimbReference& r = field::limbReference(field::kFemur);
  constexpr int kSteps = 12;
  constexpr double kInside_m = -0.02, kTrochanter_m = 0.075,
                   kCondyle_m = 0.05;  // extent of the bone, lateral positive
  for (int i = 0; i <= kSteps; ++i) {
    const double t = double(i) / kSteps;
    for (const double z : {kInside_m, kTrochanter_m})
      check(r.neck_begin + t * (r.neck_end - r.neck_begin), z, "neck_shaft", femur.neck_shaft_rad);
    for (const double z : {-kCondyle_m, kCondyle_m})
      check(r.varus_begin + t * (r.distal_begin - r.varus_begin), z, "varus", femur.varus_rad);
  }
}

void requireSound(const Skeleton& reference, const ShapeParameters& shape) {
  for (int i = 0; i < 2; ++i) {
    const SideShape& s = shape.sides[std::size_t(i)];
    const char* suffix = i == 0 ? "_r" : "_l";
    for (const auto& [bone, limb] : {std::pair{"femur", &s.femur}, std::pair{"tibia", &s.tibia},
                                     std::pair{"humerus", &s.humerus}, std::pair{"ulna", &s.ulna}})
      requireLongerThanHeads(std::string{bone} + suffix, *limb);
    requireUnfolded(reference, shape, i);
  }
}

}  // namespace

Skeleton deformedSkeleton(const Skeleton& reference, const ShapeParameters& shape) {
  validate(shape);
  requireSound(reference, shape);
  const std::vector<double> all = toVector(shape);
  Skeleton s = reference;
  for (int j = 0; j < static_cast<int>(s.joints.size()); ++j)
    s.joints[j].X_PJ = deformedJointFrame(reference, all, j);
  for (auto& landmark : s.landmarks) landmark.p_BL = deform(reference, all, landmark.segment, landmark.p_BL);
  s.segments = deformedInertias(reference, all);
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
