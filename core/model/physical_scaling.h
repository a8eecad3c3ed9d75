#pragma once
#include <cmath>
#include <map>
#include <string>

#include "core/model/model.h"

namespace sinew {

// How physical quantities change when a body is scaled by L in all dimensions, gravity and density kept: Hodgins &
// Pollard 1997, Adapting Simulated Behaviors for New Characters (SIGGRAPH), as cited by Ryu et al., Parametric
// Skeleton Model. Each function gives the factor for L.

inline double timeScale(double L) {
  return std::sqrt(L);
}
inline double velocityScale(double L) {
  return std::sqrt(L);
}
inline double forceScale(double L) {
  return L * L * L;
}
inline double massScale(double L) {
  return L * L * L;
}
inline double inertiaScale(double L) {
  return L * L * L * L * L;
}
inline double stiffnessScale(double L) {
  return L * L;
}
inline double dampingScale(double L) {
  return L * L * std::sqrt(L);
}
/// Maximal force of a muscle: with its cross-section. (Weight grows faster, L^3: large bodies are weak for their
/// weight.)
inline double strengthScale(double L) {
  return L * L;
}

/// The same for a deformation that is not uniform: the change of the unit's cross-section, as the mean over its path
/// at the zero posture of the change of a small area across the path, det J |J^-T t| (Nanson's formula; t = direction
/// of the path, J = Jacobian of the field of the segments that a point hangs on, ends of every stretch of the path
/// taken alike). L^2 for a uniform scale; 1 where a bone only gets longer along the muscle.
/// @param unit of the reference musculature. @param parameters in the order of shapeParameterNames().
double crossSectionScale(const Skeleton& reference, const MusculotendonUnit& unit,
                         const std::vector<double>& parameters);

/// The model with masses, inertias and F_max of its shape: masses and inertias of the deformed volume
/// (core/skeleton/deformed_inertia.h), times the mass factor or brought to the mass ratio of the reference's; F_max =
/// reference's times the strength factor, or times crossSectionScale() where none is named. Everything is computed
/// from `reference`, so that applying it again with other factors leaves no trace of the first. Passive structures
/// follow the new mass (scaledStructures()), joint stops the age (widenStops()), except stops that a person moved.
/// The factors stay in Model::physics.
/// @throws InputError for names that the model does not have, a factor and a ratio of one segment.
Model withPhysics(const Model& model, const Model& reference, const PhysicsFactors& factors);

/// What a body of this shape weighs if it is as dense as the reference [kg].
double volumeMass_kg(const Skeleton& reference, const ShapeParameters& shape);

/// One factor for every segment, so that a body of this shape has this mass in all [kg]: what remains between bones
/// and scales is flesh. @throws InputError if it would be beyond 1/5 to 5: mass and bones are not of one person.
std::map<std::string, double> massFactorsFor(const Skeleton& reference, const ShapeParameters& shape, double mass_kg);

}  // namespace sinew
