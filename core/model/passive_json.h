#pragma once
#include "core/passive/passive_moment.h"
#include "core/skeleton/skeleton.h"
#include "core/strict_json.h"

namespace sinew {

/// {"hip_flexion_r": {"upper": {"moment_Nm": 50, "rate_per_rad": 5.05, "angle_rad": 2.0}, "lower": {..}}, ..}:
/// coordinates and ends without structures are left out. Part of a model file.
Json passiveMomentsToJson(const PassiveMoments& moments, const Skeleton& skeleton);
/// One entry a coordinate, or none at all for an empty object. @throws InputError: unknown coordinates, the root's,
/// figures that are not positive.
PassiveMoments passiveMomentsFromJson(const JsonReader& json, const Skeleton& skeleton);

/// The same of one coordinate.
Json passiveMomentToJson(const PassiveMoment& moment);
PassiveMoment passiveMomentFromJson(const JsonReader& json);

}  // namespace sinew
