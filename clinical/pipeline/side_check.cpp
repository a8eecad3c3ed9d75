#include "clinical/pipeline/side_check.h"

#include <algorithm>

namespace sinew {
namespace {

bool isKnown(const Skeleton& reference, const Sighting& sighting) {
  const auto landmark = std::ranges::find(reference.landmarks, sighting.name, &Landmark::name);
  return landmark != reference.landmarks.end() && landmark->segment < reference.movingSegmentCount();
}

}  // namespace

ExchangeFinding examineSides(const Skeleton& reference, const BiplanarRig& rig, std::span<const Sighting> sightings,
                             const std::filesystem::path& resource_dir, const Job& job) {
  std::vector<LandmarkObservation> known;
  for (const auto& s : sightings)
    if (isKnown(reference, s)) known.push_back({s.name, s.view, s.uv_px, s.sigma_px});
  if (known.empty()) return {};
  ExchangeOptions options;
  if (rig.patient_aligned) options.anterior_W = Eigen::Vector3d::UnitX();
  return findExchangedSides(reference, projectionsOf(rig), known, loadShapePriors(resource_dir), options, job);
}

Warnings warningsOf(const ExchangeFinding& finding) {
  if (finding.exchanges.empty()) return {};
  return {{std::string{kSidesExchanged},
           "left and right are exchanged: " + finding.what +
               ". The picks fit far better with the names of the other side; exchange them (--swap, or the button on "
               "the landmarks page), or check the side markers"}};
}

bool disagreeGrossly(const SkeletonFit& fit, std::span<const SideExchange> exchanges) {
  return std::ranges::any_of(exchanges, &SideExchange::whole) ||
         std::ranges::any_of(fit.warnings, [](const Warning& w) { return w.code == "picks_disagree"; });
}

void applyExchange(std::vector<Sighting>& sightings, std::span<const SideExchange> exchanges) {
  for (auto& s : sightings)
    if (isExchanged(exchanges, s.name, s.view)) s.name = withOtherSide(s.name);
}

}  // namespace sinew
