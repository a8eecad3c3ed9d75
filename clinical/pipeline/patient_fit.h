#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/job.h"
#include "core/skeleton/fit/fit_skeleton.h"
#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"

namespace sinew {

/// The views of a rig as the fit wants them: which were taken at one instant, and how well each is known.
std::vector<FitView> fitViewsOf(const BiplanarRig& rig);
/// How exactly a person clicks [px]: the protocol's noise of a pick of this landmark (that of its first one for a
/// name that it does not know) in the view's scale where the beams cross, which is where the patient stands. Without
/// a rig, or a view of it, by the detector's pixels, `pixel_mm`.
double pickSigma_px(const std::filesystem::path& resource_dir, const std::string& landmark, const BiplanarRig* rig,
                    int view, double pixel_mm);
std::vector<LandmarkObservation> observationsOf(std::span<const Sighting> sightings);

/// Shape and posture of a patient from picks: fitSkeleton() with the population, the landmark protocol's errors of
/// definition and the rig's own uncertainty. What window, command line and pipeline fit with. @throws InputError.
SkeletonFit fitPatient(const Skeleton& reference, const BiplanarRig& rig, std::span<const Sighting> sightings,
                       const std::filesystem::path& resource_dir, const Job& job = {});

}  // namespace sinew
