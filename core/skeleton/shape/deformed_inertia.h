#pragma once
#include "core/skeleton/shape/bone_field.h"

namespace sinew {

// Masses after a deformation: every piece of the segment keeps its density and is carried along by the field.
//
// A segment stands for itself as the homogeneous box that has its mass, centre of mass and inertia (aligned with the
// principal axes). mass' = rho * integral of det J over the box, centre and second moments likewise, by
// Gauss-Legendre quadrature with 3 x 3 points across and 8 along the longest side. Exact where the field is linear in
// the box: a uniform scale L gives mass L^3 and inertia L^5, three scales along the axes of a box those of the scaled
// box.

/// Mass, centre of mass and inertia of every moving segment of `reference` after the deformation. `parameters` in the
/// order of shapeParameterNames(). Less than 1 ms a body.
std::vector<Segment> deformedInertias(const Skeleton& reference, const std::vector<double>& parameters);

}  // namespace sinew
