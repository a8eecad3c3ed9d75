#pragma once
#include <span>
#include <string>
#include <vector>

#include "imaging/rig/triangulate.h"

namespace sinew {

/// The sightings of one name.
struct SightingGroup {
  std::string name;
  std::vector<Sighting> sightings;
};
std::vector<SightingGroup> groupByName(std::span<const Sighting> sightings);

/// @throws InputError unless the rig has the sighting's view.
void requireKnownView(const BiplanarRig& rig, const Sighting& sighting);
bool inDifferentViews(std::span<const Sighting> sightings);

/// Length of the residual in units of the picking error: the mismatch of the rays.
double mismatch_sigma(const TriangulatedLandmark& point, std::span<const Sighting> sightings);
/// Mismatch that chance gives as rarely as 5 sigma of one number: n views leave 2 n - 3 numbers unexplained.
double grossMismatch_sigma(std::size_t views);

/// Rows counted from the bottom in one view or all: "flipped_y".
void warnOfFlippedRows(const BiplanarRig& rig, const std::vector<SightingGroup>& groups, Warnings& warnings);
/// Picks of one view filed under another: "swapped_views".
void warnOfSwappedViews(const BiplanarRig& rig, const std::vector<SightingGroup>& groups, Warnings& warnings);

}  // namespace sinew
