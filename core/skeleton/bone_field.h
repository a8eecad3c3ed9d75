#pragma once
#include "core/skeleton/shape.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

// The one map from shape parameters to geometry: meshes, joint centres, landmarks and muscle anchors all go through
// deform(). C1 in space: along a limb bone (axial coordinate u from the proximal joint centre) the stretch rate and
// the cross-section scale blend smoothly from proximal head to shaft to distal head; torsion turns about the curved
// shaft axis; the distal joint frame follows. See docs/methods/parametric_skeleton.md.

/// Image of the point p_B of `segment` in the deformed segment's frame. T is double or an automatic-differentiation
/// scalar; `parameters` in the order of shapeParameterNames().
template <class T>
Vector3<T> deform(const Skeleton& reference, const std::vector<T>& parameters, int segment,
                  const Eigen::Vector3d& p_B);

/// Joint frame X_PJ of `joint` after deformation of its parent.
template <class T>
RigidTransformT<T> deformedJointFrame(const Skeleton& reference, const std::vector<T>& parameters, int joint);

/// The skeleton of this shape: joint frames, landmarks, driven bodies, masses and inertias (mass with the product of
/// the mean axial and squared cross scale, inertia accordingly).
/// @throws InputError if the shape would turn a bone inside out (a limb shorter than its two heads).
Skeleton deformedSkeleton(const Skeleton& reference, const ShapeParameters& shape);

}  // namespace sinew

#include "core/skeleton/bone_field_internal.h"  // IWYU pragma: keep
