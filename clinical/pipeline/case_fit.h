#pragma once
#include <filesystem>

#include "clinical/case/case.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

/// The skeleton fitted to the landmarks of a case, as the skeleton stage does it, with the advice which landmarks of
/// the protocol would determine what is not. The case must have its geometry. Some 30 ms.
/// @throws InputError if no landmark of the skeleton is placed, or for a resource file that is unusable.
SkeletonFit fitCaseSkeleton(const Case& c, const Skeleton& reference, const std::filesystem::path& resource_dir,
                            const Job& job = {});

}  // namespace sinew
