#pragma once
#include "clinical/case/case.h"
#include "core/model/model.h"

namespace sinew {

/// Age on the day of the examination [years]; nullopt where birth or examination has no date.
std::optional<double> ageYears(const Patient& patient, const PhysicalExam& exam);

/// What the scaling rules of core/model/physical_scaling.h are to make of this patient's bones: segments share the
/// entered mass as the deformed volumes do (of a patient who was not weighed they have that of the volumes), maximal
/// forces follow the cross-sections, joints are as lax as at his ageYears() (an adult's if it is not known).
/// @throws InputError for a mass that cannot belong to these bones.
PhysicsFactors patientPhysics(const Patient& patient, const PhysicalExam& exam, const ShapeParameters& shape,
                              const Skeleton& reference);

/// How patientPhysics() went: mass entered and mass of the bones are far apart, not weighed.
Warnings patientPhysicsDoubts(const Patient& patient, const ShapeParameters& shape, const Skeleton& reference);

}  // namespace sinew
