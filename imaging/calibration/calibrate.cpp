#include "imaging/calibration/calibrate.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "imaging/calibration/calibration_internal.h"

namespace sinew {
namespace {

constexpr const char* kWhere = "bead calibration";
constexpr double kMaxFocalLengthError = 0.05;  // relative standard error; beyond, the geometry is not determined
constexpr double kDoubtful_px = 1.0;           // RMS of a sound calibration is a few tenths

std::string viewName(int view) {
  return std::string{kWhere} + ": view " + std::to_string(view + 1);
}

void requireDetermined(const CalibrationObject& object, const std::vector<BeadObservation>& observations, int view) {
  std::vector<Eigen::Vector3d> places;
  for (const auto& o : observations)
    if (o.view == view) places.push_back(object.beads[std::size_t(o.bead)].p_WQ);
  if (int(places.size()) < kMinBeads)
    throw InputError{{viewName(view), "beads", std::to_string(kMinBeads) + " or more that can be told apart",
                      std::to_string(places.size())}};
  if (flatness(places) < kMinFlatness)
    throw InputError{{viewName(view), "beads", "places that fill a volume", "all nearly in one plane"}};
}

/// Observations whose residual is beyond anything the others show.
std::vector<BeadObservation> withoutOutliers(const std::vector<BeadObservation>& observations,
                                             const std::vector<Eigen::Vector2d>& residual_px) {
  std::vector<double> sizes;
  for (const auto& r : residual_px) sizes.push_back(r.norm());
  std::nth_element(sizes.begin(), sizes.begin() + long(sizes.size() / 2), sizes.end());
  const double limit_px = std::max(5 * sizes[sizes.size() / 2], 0.5);
  std::vector<BeadObservation> kept;
  for (std::size_t i = 0; i < observations.size(); ++i)
    if (residual_px[i].norm() <= limit_px) kept.push_back(observations[i]);
  return kept;
}

void describe(BeadCalibration& result, const CalibrationObject& object, const RefinedViews& refined,
              const std::vector<BeadObservation>& used, const CalibrationOptions& options) {
  result.rms_px = refined.rms_px;
  result.accuracy_mm = refined.accuracy_mm;
  for (std::size_t i = 0; i < refined.views.size(); ++i) static_cast<View&>(result.rig.views[i]) = refined.views[i];
  result.rig.patient_aligned = options.patient_aligned;
  CalibrationRecord& record = result.rig.calibration;
  record.method = "bead_phantom";
  record.id = geometryId(result.rig.views);
  record.rms_px = refined.rms_px;
  record.accuracy_mm = refined.accuracy_mm;
  for (std::size_t i = 0; i < used.size(); ++i)
    result.residuals.push_back({object.beads[std::size_t(used[i].bead)].name, used[i].view, refined.residual_px[i]});
  std::stable_sort(
      result.residuals.begin(), result.residuals.end(),
      [](const BeadResidual& a, const BeadResidual& b) { return a.residual_px.norm() > b.residual_px.norm(); });
  result.unmatched_beads.resize(refined.views.size());
  for (int view = 0; view < int(refined.views.size()); ++view) {
    auto& unmatched = result.unmatched_beads[std::size_t(view)];
    for (std::size_t b = 0; b < object.beads.size(); ++b)
      if (std::none_of(used.begin(), used.end(),
                       [&](const BeadObservation& o) { return o.view == view && o.bead == int(b); }))
        unmatched.push_back(object.beads[b].name);
    if (unmatched.size() * 4 > object.beads.size())
      record.warnings.push_back(
          {"beads_missing", "View " + std::to_string(view + 1) + ": " + std::to_string(unmatched.size()) + " of " +
                                std::to_string(object.beads.size()) + " beads were not found."});
  }
  if (refined.rms_px > kDoubtful_px)
    record.warnings.push_back({"calibration_rms_high", "The calibration reproduces the beads to " +
                                                           std::to_string(refined.rms_px).substr(0, 4) +
                                                           " px only: did the object or the tubes move?"});
  if (std::sin(angleBetweenViews_rad(result.rig)) < 0.34)
    record.warnings.push_back({"views_nearly_parallel",
                               "The views are less than 20 deg from parallel: depth is "
                               "poorly determined."});
}

/// `start`: the rig that the refinement starts from, with the roles and exposures of the result.
BeadCalibration calibrate(const CalibrationObject& object, std::vector<BeadObservation> observations,
                          const BiplanarRig& start, const CalibrationOptions& options, const Job& job) {
  BeadCalibration result;
  const int count = int(start.views.size());
  for (int view = 0; view < count; ++view) requireDetermined(object, observations, view);
  RefinedViews refined = refineViews(object, observations, projectionsOf(start), options, job);
  for (int round = 0; round < 3 && refined.outcome == Outcome::Converged; ++round) {
    auto kept = withoutOutliers(observations, refined.residual_px);
    if (kept.size() == observations.size()) break;
    observations = std::move(kept);
    for (int view = 0; view < count; ++view) requireDetermined(object, observations, view);
    refined = refineViews(object, observations, refined.views, options, job);
  }
  result.outcome = refined.outcome;
  if (refined.outcome != Outcome::Converged) return result;
  if (!(refined.focal_length_error < kMaxFocalLengthError))
    throw InputError{{kWhere, "beads", "places that determine the geometry",
                      "focal length uncertain by more than 5 %: the beads are too few or too flat"}};
  result.rig.views = start.views;
  describe(result, object, refined, observations, options);
  return result;
}

/// Detections of one view that no bead of the result explains.
std::vector<Eigen::Vector2d> unexplained(const CalibrationObject& object, const std::vector<DetectedBead>& detected,
                                         const BeadCalibration& result, int view) {
  std::vector<Eigen::Vector2d> left;
  for (const auto& seen : detected) {
    const bool used = std::any_of(result.residuals.begin(), result.residuals.end(), [&](const BeadResidual& r) {
      const auto bead = std::find_if(object.beads.begin(), object.beads.end(),
                                     [&](const CalibrationBead& b) { return b.name == r.bead; });
      const auto uv = project(result.rig.views[std::size_t(view)], bead->p_WQ);
      return r.view == view && uv && (*uv + r.residual_px - seen.uv_px).norm() < 1e-6;
    });
    if (!used) left.push_back(seen.uv_px);
  }
  return left;
}

/// First view by the direct linear transformation.
View startFromSightings(const CalibrationObject& object, const std::vector<BeadObservation>& observations, int view,
                        const Eigen::Vector2i& size_px) {
  requireDetermined(object, observations, view);
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::Vector2d> uv_px;
  for (const auto& o : observations)
    if (o.view == view) {
      places.push_back(object.beads[std::size_t(o.bead)].p_WQ);
      uv_px.push_back(o.uv_px);
    }
  auto linear = viewFromDlt(places, uv_px);
  if (!linear) throw InputError{{viewName(view), "beads", "sightings that determine a view", "a degenerate set"}};
  linear->width_px = size_px.x();
  linear->height_px = size_px.y();
  auto& c = std::get<ConeBeam>(linear->projection);
  if (std::abs(c.fy_px / c.fx_px - 1) < 0.02) c.fy_px = c.fx_px;  // square pixels, as detectors have
  return *linear;
}

}  // namespace

BeadCalibration calibrateFromBeads(const CalibrationObject& object,
                                   std::span<const std::vector<DetectedBead>> detected, const BiplanarRig& guess,
                                   const CalibrationOptions& options, const Job& job) {
  require(detected.size() == guess.views.size(), "a list of detections for every view");
  BeadCalibration cancelled;
  cancelled.outcome = Outcome::Cancelled;
  std::vector<BeadObservation> observations;
  BiplanarRig start = guess;
  for (int view = 0; view < int(detected.size()); ++view) {
    const auto& seen = detected[std::size_t(view)];
    const View& guessed = guess.views[std::size_t(view)];
    if (!std::holds_alternative<ConeBeam>(guessed.projection))
      throw InputError{{viewName(view), "projection", "cone beam", projectionName(guessed)}};
    const auto match = matchBeads(object, seen, guessed, job);
    if (job.cancelled()) return cancelled;
    if (!match)
      throw InputError{{viewName(view), "beads", "a pose of '" + object.name + "' that explains the round shadows",
                        "none for " + std::to_string(seen.size()) +
                            " shadows: is it the right object, upright and whole in the image?"}};
    static_cast<View&>(start.views[std::size_t(view)]) = match->view;
    for (const auto& [bead, detection] : match->pairs)
      observations.push_back(
          {bead, view, seen[std::size_t(detection)].uv_px, seen[std::size_t(detection)].sigma_px, detection});
  }
  BeadCalibration result = calibrate(object, observations, start, options, job);
  if (result.outcome != Outcome::Converged) return result;
  for (int view = 0; view < int(detected.size()); ++view)
    result.unmatched_px.push_back(unexplained(object, detected[std::size_t(view)], result, view));
  return result;
}

BeadCalibration calibrateFromSightings(const CalibrationObject& object, std::span<const Sighting> sightings,
                                       std::span<const Eigen::Vector2i> image_sizes_px,
                                       const CalibrationOptions& options, const Job& job) {
  std::vector<std::string> names;
  for (const auto& bead : object.beads) names.push_back(bead.name);
  std::vector<BeadObservation> observations;
  for (const auto& s : sightings) {
    const auto found = std::find(names.begin(), names.end(), s.name);
    if (found == names.end())
      throw InputError{
          {kWhere, "sighting", "a bead of '" + object.name + "'", "'" + s.name + "'" + didYouMean(s.name, names)}};
    if (s.view < 0 || s.view >= int(image_sizes_px.size()))
      throw InputError{{kWhere, "sighting of " + s.name, "a view from 1 to " + std::to_string(image_sizes_px.size()),
                        "view " + std::to_string(s.view + 1)}};
    observations.push_back({int(found - names.begin()), s.view, s.uv_px, s.sigma_px, -1});
  }
  BiplanarRig start;
  start.views.clear();
  for (int view = 0; view < int(image_sizes_px.size()); ++view) {
    RigView first{startFromSightings(object, observations, view, image_sizes_px[std::size_t(view)]), ViewRole::Other,
                  view};
    if (options.patient_aligned) first.role = roleOfBeam(first);
    start.views.push_back(first);
  }
  return calibrate(object, observations, start, options, job);
}

}  // namespace sinew
