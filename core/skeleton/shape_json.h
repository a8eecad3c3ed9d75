#pragma once
#include "core/skeleton/shape.h"
#include "core/strict_json.h"

namespace sinew {

/// {"pelvis.width": 1.02, "femur_r.torsion_rad": 0.1, ...}: every parameter, angles with their unit.
Json shapeToJson(const ShapeParameters& shape);
/// @throws InputError for a missing or unknown parameter, or a value that the deformation cannot represent.
ShapeParameters shapeFromJson(const JsonReader& json);

}  // namespace sinew
