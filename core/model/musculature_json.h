#pragma once
#include "core/muscle/musculature.h"
#include "core/skeleton/skeleton.h"
#include "core/strict_json.h"

namespace sinew {

/// List of units as part of a model file.
Json musculatureToJson(const Musculature& musculature, const Skeleton& skeleton);
/// @throws InputError: unknown segments, weights that are no partition, figures that are not positive, names twice.
Musculature musculatureFromJson(const JsonReader& json, const Skeleton& skeleton);

}  // namespace sinew
