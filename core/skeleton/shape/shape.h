#pragma once
#include <array>
#include <string>
#include <vector>

namespace sinew {

/// Shape of one limb bone relative to the reference. Every added angle and length is 0 in the reference; signs are
/// the same on both sides.
struct LimbBoneShape {
  double elongation = 1;       ///< joint-centre to joint-centre length ratio; the shaft takes up the change
  double proximal_scale = 1;   ///< size of the proximal head, about its joint centre
  double distal_scale = 1;     ///< size of the distal head, about its joint centre
  double torsion_rad = 0;      ///< added torsion, distributed over the shaft; positive = distal end turned outwards
  double neck_shaft_rad = 0;   ///< added neck-shaft angle below the trochanters (femur only); positive = valgus
  double varus_rad = 0;        ///< frontal bend at the knee: femur just above it, tibia just below; positive = varus
  double procurvatum_rad = 0;  ///< sagittal bend at the same place (femur, tibia); positive = apex anterior
  double neck_length_m = 0;    ///< added length of the neck, along its axis (femur only)
  double neck_varus_rad = 0;   ///< bend in the neck itself (femur only); positive = head lower (coxa vara)
  double neck_retroversion_rad = 0;   ///< the same in the transverse plane; positive = head further behind
  double bow_frontal_rad = 0;         ///< bow of the whole shaft (femur only); positive = apex lateral
  double bow_sagittal_rad = 0;        ///< the same in the sagittal plane; positive = apex anterior
  double distal_varus_rad = 0;        ///< frontal bend just above the ankle (tibia only); positive = varus
  double distal_procurvatum_rad = 0;  ///< sagittal bend just above the ankle (tibia only); positive = apex anterior
  friend bool operator==(const LimbBoneShape&, const LimbBoneShape&) = default;
};

/// Where the femoral head's centre stands against the acetabulum's, along the pelvis' axes: not zero in a subluxated
/// or dislocated hip. The whole leg moves with it.
struct HipShape {
  double lateral_m = 0, superior_m = 0, anterior_m = 0;
  friend bool operator==(const HipShape&, const HipShape&) = default;
};

/// One side of the body.
struct SideShape {
  LimbBoneShape femur, tibia, humerus, ulna;
  double foot_scale = 1, hand_scale = 1;
  HipShape hip;
  friend bool operator==(const SideShape&, const SideShape&) = default;
};

/// A whole body relative to the reference (Ryu et al., Parametric Skeleton Model; pelvis, hips, and all angles of the
/// lower limb but torsion are our additions, because radiographs show them). The identity is the default value.
struct ShapeParameters {
  double pelvis_width = 1, pelvis_height = 1, pelvis_depth = 1;
  double trunk_elongation = 1, trunk_expansion = 1, trunk_bend_rad = 0;  ///< bend: positive = forward
  double neck_elongation = 1, head_scale = 1;
  std::array<SideShape, 2> sides;  ///< right, left
  friend bool operator==(const ShapeParameters&, const ShapeParameters&) = default;
};

/// Every parameter as a flat list, for solvers, files and forms: "femur_r.elongation", "pelvis.width", ...
/// Angles are radians here, lengths metres.
const std::vector<std::string>& shapeParameterNames();
std::vector<double> toVector(const ShapeParameters& shape);
ShapeParameters shapeFromVector(const std::vector<double>& values);

/// What a parameter is: a ratio to the reference (neutral 1), an added angle or an added length (neutral 0).
enum class ShapeUnit { Ratio, Angle, Length };
/// By the parameter's quantity, with or without a side: "femur_r.torsion", "femur.torsion".
ShapeUnit shapeUnit(const std::string& parameter);
/// Angles do not grow with the size of a body; everything else does.
inline bool isShapeAngle(const std::string& parameter) {
  return shapeUnit(parameter) == ShapeUnit::Angle;
}

/// What a parameter may be at all; combinations that turn a bone inside out are refused by deformedSkeleton().
inline constexpr double kLeastShapeRatio = 0.2, kGreatestShapeRatio = 4, kGreatestShapeAngle_rad = 1.5707963267948966,
                        kGreatestShapeLength_m = 0.15;

/// @throws InputError, naming the parameter, for a value outside these bounds (NaN included).
void validate(const ShapeParameters& shape);

}  // namespace sinew
