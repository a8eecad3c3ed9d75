#pragma once
#include <memory>
#include <vector>

#include "core/model/model.h"

namespace sinew {

/// The reference's surfaces carried by the deformation field; segments are looked up by name in `skeleton`.
/// @throws InputError if `skeleton` lacks a segment that a bone belongs to.
std::shared_ptr<const std::vector<BoneMesh>> deformedBones(const Model& reference, const ShapeParameters& shape,
                                                           const Skeleton& skeleton);

}  // namespace sinew
