#pragma once
#include "core/posture/validity.h"
#include "core/rom/edit/rom_transform.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

// What an edit asks for, V~(q) = V(T(q)) of Ryu et al. (ROM Editing): the reference's own answer at T(q).

/// V~(q) with what decides it; nullopt where T has no image (not valid).
std::optional<Validity> editedValidity(const Model& reference, const RomTransform& transform, const Posture& q);

/// The map that an edit asks for, cells as romMap() has them; what is held is transformed too, if its joint is
/// edited.
RomMap editedRomMap(const Model& reference, const RomTransform& transform, const std::string& joint,
                    const Posture& held, const RomMapOptions& options = {});

/// Where the stops of an edited hinge go: exactly as its range.
struct HingeStops {
  double min_rad = 0, max_rad = 0;
};
HingeStops editedStops(const Skeleton& reference, const RomTransform& transform, int joint);

}  // namespace sinew
