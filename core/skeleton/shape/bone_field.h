#pragma once
#include "core/skeleton/shape/shape.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

// The one map from shape parameters to geometry: meshes, joint centres, landmarks and muscle anchors all go through
// deform(). C1 in space and in the parameters, with a C1 inverse: along a limb bone (axial coordinate u from the
// proximal joint centre) the stretch rate and the cross-section scale blend smoothly from proximal head to shaft to
// distal head; torsion turns about the curved shaft axis; the distal joint frame follows. See
// docs/methods/parametric_skeleton.md. Derivatives and inverse: field_derivatives.h, undeform() below.

/// Image of the point p_B of `segment` in the deformed segment's frame. T is double or an automatic-differentiation
/// scalar; `parameters` in the order of shapeParameterNames().
template <class T>
Vector3<T> deform(const Skeleton& reference, const std::vector<T>& parameters, int segment,
                  const Eigen::Vector3d& p_B);

/// The point of the reference that deform() takes to p_B: within 1e-12 m for bodies that deformedSkeleton() accepts.
/// @throws InputError for parameters outside validate(), and for the one place that no point of the reference
/// reaches: the centre of the arc on which a trunk segment is bent.
Eigen::Vector3d undeform(const Skeleton& reference, const std::vector<double>& parameters, int segment,
                         const Eigen::Vector3d& p_B);

/// Joint frame X_PJ of `joint` after deformation of its parent.
template <class T>
RigidTransformT<T> deformedJointFrame(const Skeleton& reference, const std::vector<T>& parameters, int joint);

/// The skeleton of this shape: joint frames, landmarks, driven bodies, masses and inertias (of the deformed volume,
/// see deformed_inertia.h).
/// @throws InputError naming the parameter if a limb would be much shorter than its two heads, or if a bend would
/// fold femur or tibia.
Skeleton deformedSkeleton(const Skeleton& reference, const ShapeParameters& shape);

}  // namespace sinew

#include "core/skeleton/shape/bone_field_internal.h"  // IWYU pragma: keep
