#include "clinical/pipeline/patient_fit.h"

#include "core/skeleton/fit/landmark_protocol.h"
#include "imaging/rig/rig_uncertainty.h"

namespace sinew {
namespace {

FitOptions optionsFrom(const std::filesystem::path& resource_dir) {
  FitOptions options;
  options.definition_errors = definitionErrors(loadLandmarkProtocol(resource_dir));
  return options;
}

}  // namespace

std::vector<FitView> fitViewsOf(const BiplanarRig& rig) {
  std::vector<FitView> views;
  for (const RigView& view : rig.views) views.push_back({view, view.exposure, uncertaintyOf(rig.calibration, view)});
  return views;
}

SkeletonFit fitPatient(const Skeleton& reference, const BiplanarRig& rig, std::span<const Sighting> sightings,
                       const std::filesystem::path& resource_dir, const Job& job) {
  std::vector<LandmarkObservation> observations;
  for (const auto& s : sightings) observations.push_back({s.name, s.view, s.uv_px, s.sigma_px});
  return fitSkeleton(reference, fitViewsOf(rig), observations, loadShapePriors(resource_dir),
                     optionsFrom(resource_dir), job);
}

}  // namespace sinew
