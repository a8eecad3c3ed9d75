#pragma once
#include <string>

#include "core/strict_json.h"
#include "imaging/rig/biplanar_rig.h"

namespace sinew {

/// "sinew.rig", version 1: what rig files hold and what a case embeds. Metres, pixels; NaN is null.
Json rigToJson(const BiplanarRig& rig);
/// One view without role and exposure: what geometryId() hashes.
Json projectionToJson(const View& view);
/// Files from before roles: the role is read off the beam (where the rig is patient aligned), and all views but those
/// of a slot scanner or of a biplane laboratory's files are exposures of their own.
/// @throws InputError for fewer than two views, a member that is missing, unknown or of a wrong type, a matrix that
/// is not orthonormal (a mirrored film, with determinant -1, is legal), a size, spacing or focal length that is not
/// positive.
BiplanarRig rigFromJson(const JsonReader& json);

}  // namespace sinew
