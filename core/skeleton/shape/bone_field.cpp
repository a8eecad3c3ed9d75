#include "core/skeleton/shape/bone_field.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "core/angle.h"
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

/// The bends of femur and tibia bring points at their sides together. Torsion only shears, and the other fields
/// cannot fold.
struct BentBone {
  const char* name;
  field::Kind kind;
  int bends, end;                                                    ///< of its bends among the parameters of a side
  double top_u_m, bottom_u_m, front_m, back_m, outside_m, inside_m;  ///< extent of the bone, reference
};
constexpr BentBone kBentBones[] = {{"femur", field::Kind::Femur, field::kFemur + field::kVarus, field::kTibia, -0.02,
                                    0.45, 0.03, -0.03, 0.06, -0.045},
                                   {"tibia", field::Kind::Tibia, field::kTibia + field::kVarus, field::kHumerus, 0.02,
                                    0.44, 0.03, -0.03, 0.042, -0.038}};

/// The bend without which there would be most volume at p: the one to blame.
int worstBend(const Skeleton& reference, const std::vector<double>& all, const field::Place& place, int first,
              int last, const Eigen::Vector3d& p) {
  int worst = first;
  double most = -std::numeric_limits<double>::infinity();
  for (int k = first; k < last; ++k) {
    if (all[std::size_t(k)] == 0) continue;
    std::vector<double> without = all;
    without[std::size_t(k)] = 0;
    const double left = field::jacobianAt(reference, field::pointJets(without), place, p).d_point.determinant();
    if (left > most) most = left, worst = k;
  }
  return worst;
}

void requireUnfolded(const Skeleton& reference, const std::vector<double>& all, const BentBone& bone, bool left) {
  const int side = field::kSideBegin + (left ? field::kSideCount : 0);
  const int first = side + bone.bends, last = side + bone.end;
  std::vector<double> straight = all;
  std::fill(straight.begin() + first, straight.begin() + last, 0.0);
  if (straight == all) return;
  const auto bent_jets = field::pointJets(all), straight_jets = field::pointJets(straight);
  const field::Place place{bone.kind, left};
  constexpr int kLevels = 36;
  constexpr double kLeastShare = 0.1;  // of the volume that it has without the bends
  for (int i = 0; i <= kLevels; ++i)
    for (const double x : {bone.back_m, bone.front_m})
      for (const double z : {bone.inside_m, bone.outside_m}) {
        const double u = bone.top_u_m + (bone.bottom_u_m - bone.top_u_m) * i / kLevels;
        const Eigen::Vector3d p{x, -u, left ? -z : z};
        if (field::jacobianAt(reference, bent_jets, place, p).d_point.determinant() >=
            kLeastShare * field::jacobianAt(reference, straight_jets, place, p).d_point.determinant())
          continue;
        const std::size_t k = std::size_t(worstBend(reference, all, place, first, last, p));
        const std::string& name = shapeParameterNames()[k];
        const bool angle = isShapeAngle(name);
        throw InputError{
            {"shape", name, "a bend that does not fold the bone, given its elongation",
             angle ? std::to_string(all[k] / kRadPerDeg) + " deg" : std::to_string(1e3 * all[k]) + " mm"}};
      }
}

void requireSound(const Skeleton& reference, const ShapeParameters& shape) {
  const std::vector<double> all = toVector(shape);
  for (int i = 0; i < 2; ++i) {
    const SideShape& s = shape.sides[std::size_t(i)];
    const char* suffix = i == 0 ? "_r" : "_l";
    for (const auto& [bone, limb] : {std::pair{"femur", &s.femur}, std::pair{"tibia", &s.tibia},
                                     std::pair{"humerus", &s.humerus}, std::pair{"ulna", &s.ulna}})
      requireLongerThanHeads(std::string{bone} + suffix, *limb);
    for (const BentBone& bone : kBentBones) requireUnfolded(reference, all, bone, i == 1);
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
