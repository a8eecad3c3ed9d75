#include "imaging/rig/sighting_groups_internal.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace sinew {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kEnough = 3;      // fewer groups agree by chance
constexpr double kFarBetter = 1.0 / 5;  // of the mismatch as given

/// Median mismatch of the groups after `change` was made to every sighting.
double medianMismatch_sigma(const BiplanarRig& rig, std::vector<SightingGroup> groups,
                            const std::function<void(Sighting&)>& change) {
  std::vector<double> values;
  for (auto& group : groups) {
    for (auto& s : group.sightings) change(s);
    const auto point = triangulate(rig, group.sightings);
    values.push_back(point ? mismatch_sigma(*point, group.sightings) : kInfinity);
  }
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// The mismatch that a change has to beat; nullopt if nothing is wrong, or too little is known.
std::optional<double> mismatchToBeat_sigma(const BiplanarRig& rig, const std::vector<SightingGroup>& groups) {
  if (groups.size() < kEnough) return std::nullopt;
  const double as_given = medianMismatch_sigma(rig, groups, [](Sighting&) {});
  if (as_given <= grossMismatch_sigma(2)) return std::nullopt;
  return as_given * kFarBetter;
}

}  // namespace

std::vector<SightingGroup> groupByName(std::span<const Sighting> sightings) {
  std::vector<SightingGroup> groups;
  for (const auto& s : sightings) {
    auto group = std::ranges::find(groups, s.name, &SightingGroup::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {s.name, {}});
    group->sightings.push_back(s);
  }
  return groups;
}

void requireKnownView(const BiplanarRig& rig, const Sighting& s) {
  if (s.view >= 0 && s.view < int(rig.views.size())) return;
  throw InputError{{"sightings", s.name, "a view from 1 to " + std::to_string(rig.views.size()),
                    "view " + std::to_string(s.view + 1)}};
}

bool inDifferentViews(std::span<const Sighting> sightings) {
  for (std::size_t i = 0; i < sightings.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (sightings[i].view == sightings[k].view) return false;
  return true;
}

double mismatch_sigma(const TriangulatedLandmark& point, std::span<const Sighting> sightings) {
  double sum = 0;
  for (std::size_t i = 0; i < sightings.size(); ++i)
    sum += (point.residuals[i].residual_px / sightings[i].sigma_px).squaredNorm();
  return std::sqrt(sum);
}

double grossMismatch_sigma(std::size_t views) {
  // Quantiles of chi-squared at 1 - 5.7e-7: 25.0, 31.9, 37.3, 42.1 for 1, 3, 5, 7 degrees of freedom.
  const double freedom = 2 * double(views) - 3;
  return std::sqrt(25 + 2.9 * (freedom - 1));
}

void warnOfFlippedRows(const BiplanarRig& rig, const std::vector<SightingGroup>& groups, Warnings& warnings) {
  const auto to_beat = mismatchToBeat_sigma(rig, groups);
  if (!to_beat) return;
  constexpr int kAll = -1;
  double best = *to_beat;
  std::optional<int> best_view;
  for (int view = kAll; view < int(rig.views.size()); ++view) {
    const double flipped = medianMismatch_sigma(rig, groups, [&](Sighting& s) {
      if (view == kAll || s.view == view) s.uv_px.y() = rig.views[std::size_t(s.view)].height_px - 1 - s.uv_px.y();
    });
    if (flipped < best) best = flipped, best_view = view;
  }
  if (!best_view) return;
  const std::string views = *best_view != kAll      ? "view " + std::to_string(*best_view + 1)
                            : rig.views.size() == 2 ? "both views"
                                                    : "all views";
  warnings.push_back({"flipped_y", "The sightings of " + views +
                                       " fit only if v is counted upwards from the bottom row: another y "
                                       "convention; expected v downwards from the top row."});
}

void warnOfSwappedViews(const BiplanarRig& rig, const std::vector<SightingGroup>& groups, Warnings& warnings) {
  const auto to_beat = mismatchToBeat_sigma(rig, groups);
  if (!to_beat) return;
  double best = *to_beat;
  std::optional<std::pair<int, int>> exchanged;
  for (int i = 0; i < int(rig.views.size()); ++i)
    for (int k = i + 1; k < int(rig.views.size()); ++k) {
      const double swapped = medianMismatch_sigma(rig, groups, [&](Sighting& s) {
        if (s.view == i || s.view == k) s.view = i + k - s.view;
      });
      if (swapped < best) best = swapped, exchanged = {i, k};
    }
  if (exchanged)
    warnings.push_back({"swapped_views", "The sightings fit only if view " + std::to_string(exchanged->first + 1) +
                                             " and view " + std::to_string(exchanged->second + 1) +
                                             " are exchanged."});
}

}  // namespace sinew
