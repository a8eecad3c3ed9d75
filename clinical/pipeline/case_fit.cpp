#include "clinical/pipeline/case_fit.h"

#include "core/skeleton/fit/landmark_protocol.h"

namespace sinew {

SkeletonFit fitCaseSkeleton(const Case& c, const Skeleton& reference, const std::filesystem::path& resource_dir,
                            const Job& job) {
  std::vector<LandmarkObservation> observations;
  for (const auto& s : c.sightings) observations.push_back({s.name, s.view, s.uv_px, s.sigma_px});
  FitOptions options;
  for (const auto& landmark : loadLandmarkProtocol(resource_dir)) options.offered_landmarks.push_back(landmark.name);
  return fitSkeleton(reference, c.rig->views, observations, loadShapePriors(resource_dir), options, job);
}

}  // namespace sinew
