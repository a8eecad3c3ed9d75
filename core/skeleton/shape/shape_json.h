#pragma once
#include "core/skeleton/shape/body_description.h"
#include "core/skeleton/shape/shape.h"
#include "core/strict_json.h"

namespace sinew {

/// {"pelvis.width": 1.02, "femur_r.torsion_rad": 0.1, ...}: every parameter, angles and lengths with their unit. For
/// files that the program writes for itself.
Json shapeToJson(const ShapeParameters& shape);
/// Hips, bows, and the other bends of the lower limb may be missing: older files do not have them, and mean 0.
/// @throws InputError for a missing or unknown parameter, or a value that the deformation cannot represent.
ShapeParameters shapeFromJson(const JsonReader& json);

/// The file of a person ("sinew.shape"): {"femur": {"elongation": 1.2}, "tibia_l.torsion_deg": 10, "strength":
/// {...}}. Fields that are 1 or 0 deg are left out.
Json bodyToJson(const BodyDescription& body);
/// The name is empty if the file gives none. @throws InputError: where, field, expected, found.
BodyDescription bodyFromJson(const JsonReader& json);

/// {"mass_factors": {"femur_r": 1.2}, "mass_ratios": {}, "strength_factors": {"quadriceps": 0.8}, "age_years": 7}
Json physicsFactorsToJson(const PhysicsFactors& factors);
/// @throws InputError for a segment that carries no mass, a factor that is none.
PhysicsFactors physicsFactorsFromJson(const JsonReader& json);

/// Segments that the parts of a body stand for: "trunk" = lumbar, thorax and both scapulae, "femur" = both sides.
/// Empty for a name that is none.
std::vector<std::string> segmentsOfPart(const std::string& part);
/// Every name that segmentsOfPart() knows.
const std::vector<std::string>& massParts();

}  // namespace sinew
