#pragma once
#include "core/skeleton/skeleton.h"
#include "core/strict_json.h"

namespace sinew {

/// Skeleton as part of a model file: metres, radians, kilograms; segments and joints by name.
Json skeletonToJson(const Skeleton& skeleton);
/// @throws InputError for anything that is not a skeleton: unknown names, turned-over order, frames that are no
/// rotations.
Skeleton skeletonFromJson(const JsonReader& json);

// Three numbers; also for the muscles.
Json vectorToJson(const Eigen::Vector3d& v);
Eigen::Vector3d vectorFromJson(const JsonReader& json);

/// Index that `lookup` finds for `name`; its complaint gets the place in the file.
template <class Lookup>
int namedIndex(const JsonReader& place, const std::string& name, const Lookup& lookup) {
  try {
    return lookup(name);
  } catch (const InputError& error) {
    throw InputError{place.where() + ": " + place.path() + ": " + error.what()};
  }
}
/// The same for a name that is the value in `json`.
template <class Lookup>
int namedIndex(const JsonReader& json, const Lookup& lookup) {
  return namedIndex(json, json.text(), lookup);
}

}  // namespace sinew
