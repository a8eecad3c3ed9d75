#pragma once
#include <filesystem>

#include "core/foreign/foreign_model.h"
#include "core/strict_json.h"

namespace sinew {

/// "sinew.foreign_model", version 1: bodies, coordinates, joints, couplings, wrap objects, muscles with their paths,
/// warnings. Metres, radians, kilograms, newtons; bodies and coordinates by name, the ground is "ground".
Json foreignModelToJson(const ForeignModel& model);
/// @throws InputError: where, field, expected, found.
ForeignModel foreignModelFromJson(const JsonReader& json);

void saveForeignModel(const ForeignModel& model, const std::filesystem::path& file);

/// Whether a file name or the start of a file says that it holds a foreign model: ".osim", or JSON of this format.
bool isForeignModelFile(const std::filesystem::path& file);
/// Reads either. @throws InputError: where, field, expected, found.
ForeignModel loadForeignModel(const std::filesystem::path& file);

}  // namespace sinew
