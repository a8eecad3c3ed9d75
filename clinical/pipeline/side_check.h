#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "core/skeleton/fit/side_exchange.h"
#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"

namespace sinew {

/// Left and right exchanged among a patient's picks. Nothing is found, and nothing thrown, where no pick is a
/// landmark of the skeleton.
ExchangeFinding examineSides(const Skeleton& reference, const BiplanarRig& rig, std::span<const Sighting> sightings,
                             const std::filesystem::path& resource_dir, const Job& job = {});

/// Code of the warning that names an exchange.
inline constexpr std::string_view kSidesExchanged = "sides_exchanged";
/// One for what was found: what is exchanged, where, and how to put it right; none if nothing was.
Warnings warningsOf(const ExchangeFinding& finding);

/// Whether picks contradict each other or the anatomy so much that no figure of the fit is to be used: as many as
/// "picks_disagree" says, or the names of a whole bone or view.
bool disagreeGrossly(const SkeletonFit& fit, std::span<const SideExchange> exchanges);

/// Gives the picks concerned the names of the other side; applied twice nothing has changed.
void applyExchange(std::vector<Sighting>& sightings, std::span<const SideExchange> exchanges);

}  // namespace sinew
