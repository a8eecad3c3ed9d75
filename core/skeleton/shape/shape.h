#pragma once
#include <array>
#include <string>
#include <vector>

namespace sinew {

/// Shape of one limb bone relative to the reference.
struct LimbBoneShape {
  double elongation = 1;      ///< joint-centre to joint-centre length ratio; the shaft takes up the change
  double proximal_scale = 1;  ///< size of the proximal head, about its joint centre
  double distal_scale = 1;    ///< size of the distal head, about its joint centre
  double torsion_rad = 0;     ///< added torsion, distributed over the shaft; positive = distal end turned outwards
  double neck_shaft_rad = 0;  ///< added neck-shaft angle (femur only); positive = valgus
  double varus_rad = 0;       ///< added frontal angle of the distal joint (femur only); positive = varus
  friend bool operator==(const LimbBoneShape&, const LimbBoneShape&) = default;
};

/// One side of the body.
struct SideShape {
  LimbBoneShape femur, tibia, humerus, ulna;
  double foot_scale = 1, hand_scale = 1;
  friend bool operator==(const SideShape&, const SideShape&) = default;
};

/// A whole body relative to the reference (Ryu et al., Parametric Skeleton Model; pelvis, neck-shaft and varus angles
/// are our additions, because radiographs show them). The identity is the default value.
struct ShapeParameters {
  double pelvis_width = 1, pelvis_height = 1, pelvis_depth = 1;
  double trunk_elongation = 1, trunk_expansion = 1, trunk_bend_rad = 0;  ///< bend: positive = forward
  double neck_elongation = 1, head_scale = 1;
  std::array<SideShape, 2> sides;  ///< right, left
  friend bool operator==(const ShapeParameters&, const ShapeParameters&) = default;
};

/// Every parameter as a flat list, for solvers, files and forms: "femur_r.elongation", "pelvis.width", ...
/// Angles are radians here.
const std::vector<std::string>& shapeParameterNames();
std::vector<double> toVector(const ShapeParameters& shape);
ShapeParameters shapeFromVector(const std::vector<double>& values);

/// What a parameter may be at all; combinations that turn a bone inside out are refused by deformedSkeleton().
inline constexpr double kLeastShapeRatio = 0.2, kGreatestShapeRatio = 4, kGreatestShapeAngle_rad = 1.5707963267948966;

/// @throws InputError, naming the parameter, for a value outside these bounds (NaN included).
void validate(const ShapeParameters& shape);

}  // namespace sinew
