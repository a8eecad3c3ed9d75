#pragma once
#include <vector>

#include "core/model/model.h"
#include "imaging/rig/sighting.h"

namespace sinew {

/// Bones of the model that the landmarks in the images speak about: those on segments that carry a sighted landmark,
/// and the patellae between them. The rest of the body is only the population's and is not drawn over images.
std::vector<BoneMesh> supportedBones(const Model& model, const std::vector<Sighting>& sightings);

}  // namespace sinew
