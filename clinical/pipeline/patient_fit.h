#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/skeleton/fit/side_exchange.h"
#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"

namespace sinew {

// How a patient's picks become a skeleton, for pipeline, command line and window: the fit is told what the rig knows
// of exposures and errors of the geometry, and what the protocol knows of how sharply landmarks are defined.

std::vector<FitView> fitViewsOf(const BiplanarRig& rig);
/// How exactly a person clicks [px]: the protocol's noise of a pick of this landmark (that of its first one for a
/// name that it does not know) in the view's scale where the beams cross, which is where the patient stands. Without
/// a rig, or a view of it, by the detector's pixels, `pixel_mm`.
double pickSigma_px(const std::filesystem::path& resource_dir, const std::string& landmark, const BiplanarRig* rig,
                    int view, double pixel_mm);
std::vector<LandmarkObservation> observationsOf(std::span<const Sighting> sightings);

/// @throws InputError as fitSkeleton().
SkeletonFit fitPatient(const Skeleton& reference, const BiplanarRig& rig, std::span<const Sighting> sightings,
                       const std::filesystem::path& resource_dir, const Job& job = {});

/// Left and right exchanged among the picks. Nothing is found, and nothing thrown, where no pick is a landmark of the
/// skeleton.
ExchangeFinding examineSides(const Skeleton& reference, const BiplanarRig& rig, std::span<const Sighting> sightings,
                             const std::filesystem::path& resource_dir, const Job& job = {});

/// Code of the warning that names an exchange.
inline constexpr std::string_view kSidesExchanged = "sides_exchanged";
/// One for what was found: what is exchanged, where, and how to put it right; none if nothing was.
Warnings warningsOf(const ExchangeFinding& finding);

/// Whether picks contradict each other or the anatomy so much that no figure of the fit is to be used: as many as
/// "picks_disagree" says, or the names of a whole bone or view.
bool disagreeGrossly(const SkeletonFit& fit, std::span<const SideExchange> whole_exchanges);

/// Gives the picks concerned the names of the other side; applied twice nothing has changed.
void applyExchange(std::vector<Sighting>& sightings, std::span<const SideExchange> exchanges);

}  // namespace sinew
