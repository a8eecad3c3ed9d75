#include "clinical/pipeline/patient_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/skeleton/fit/landmark_protocol.h"
#include "imaging/rig/rig_uncertainty.h"

namespace sinew {
namespace {

/// The point nearest to the axes of all beams.
Eigen::Vector3d middleOf(const BiplanarRig& rig) {
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const View& view : rig.views) {
    const Ray axis = backProject(view, principalPoint_px(view));
    const Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() - axis.direction_W * axis.direction_W.transpose();
    across += normal;
    sum += normal * axis.origin_W;
  }
  return across.ldlt().solve(sum);
}

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

double pickSigma_px(const std::filesystem::path& resource_dir, const std::string& landmark, const BiplanarRig* rig,
                    int view, double pixel_mm) {
  const auto protocol = loadLandmarkProtocol(resource_dir);
  const auto known = std::ranges::find(protocol, landmark, &ProtocolLandmark::name);
  const double sd_mm = (known == protocol.end() ? protocol.front() : *known).pick_sd_mm;
  if (rig && view < static_cast<int>(rig->views.size())) {
    const double scale = pixelsPerMillimetre(rig->views[static_cast<std::size_t>(view)], middleOf(*rig));
    if (std::isfinite(scale) && scale > 0) return sd_mm * scale;
  }
  return sd_mm / pixel_mm;
}

std::vector<LandmarkObservation> observationsOf(std::span<const Sighting> sightings) {
  std::vector<LandmarkObservation> list;
  for (const auto& s : sightings) list.push_back({s.name, s.view, s.uv_px, s.sigma_px});
  return list;
}

SkeletonFit fitPatient(const Skeleton& reference, const BiplanarRig& rig, std::span<const Sighting> sightings,
                       const std::filesystem::path& resource_dir, const Job& job) {
  FitOptions options = optionsFrom(resource_dir);
  for (const auto& landmark : loadLandmarkProtocol(resource_dir)) options.offered_landmarks.push_back(landmark.name);
  return fitSkeleton(reference, fitViewsOf(rig), observationsOf(sightings), loadShapePriors(resource_dir), options,
                     job);
}

}  // namespace sinew
