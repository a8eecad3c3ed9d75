#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "core/job.h"
#include "core/skeleton/fit/fit_skeleton.h"
#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"

namespace sinew {

/// The views of a rig as the fit wants them: which were taken at one instant, and how well each is known.
std::vector<FitView> fitViewsOf(const BiplanarRig& rig);

/// Shape and posture of a patient from picks: fitSkeleton() with the population, the landmark protocol's errors of
/// definition and the rig's own uncertainty. What window, command line and pipeline fit with. @throws InputError.
SkeletonFit fitPatient(const Skeleton& reference, const BiplanarRig& rig, std::span<const Sighting> sightings,
                       const std::filesystem::path& resource_dir, const Job& job = {});

}  // namespace sinew
