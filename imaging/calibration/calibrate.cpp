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
  result.rig.views = refined.views;
  result.rig.patient_aligned = options.patient_aligned;
  CalibrationRecord& record = result.rig.calibration;
  record.method = "bead_phantom";
  record.id = geometryId(refined.views);
  record.rms_px = refined.rms_px;
  record.accuracy_mm = refined.accuracy_mm;
  for (std::size_t i = 0; i < used.size(); ++i)
    result.residuals.push_back({object.beads[std::size_t(used[i].bead)].name, used[i].view, refined.residual_px[i]});
  std::stable_sort(
      result.residuals.begin(), result.residuals.end(),
      [](const BeadResidual& a, const BeadResidual& b) { return a.residual_px.norm() > b.residual_px.norm(); });
  for (int view = 0; view < 2; ++view) {
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
                               "The two views are less than 20 deg from parallel: depth is "
                               "poorly determined."});
}

BeadCalibration calibrate(const CalibrationObject& object, std::vector<BeadObservation> observations,
                          const std::array<View, 2>& start, const CalibrationOptions& options, const Job& job) {
  BeadCalibration result;
  for (int view : {0, 1}) requireDetermined(object, observations, view);
  RefinedViews refined = refineViews(object, observations, start, options, job);
  for (int round = 0; round < 3 && refined.outcome == Outcome::Converged; ++round) {
    auto kept = withoutOutliers(observations, refined.residual_px);
    if (kept.size() == observations.size()) break;
    observations = std::move(kept);
    for (int view : {0, 1}) requireDetermined(object, observations, view);
    refined = refineViews(object, observations, refined.views, options, job);
  }
  result.outcome = refined.outcome;
  if (refined.outcome != Outcome::Converged) return result;
  if (!(refined.focal_length_error < kMaxFocalLengthError))
    throw InputError{{kWhere, "beads", "places that determine the geometry",
                      "focal length uncertain by more than 5 %: the beads are too few or too flat"}};
  describe(result, object, refined, observations, options);
  return result;
}

}  // namespace

BeadCalibration calibrateFromBeads(const CalibrationObject& object,
                                   const std::array<std::vector<DetectedBead>, 2>& detected, const BiplanarRig& guess,
                                   const CalibrationOptions& options, const Job& job) {
  BeadCalibration cancelled;
  cancelled.outcome = Outcome::Cancelled;
  std::vector<BeadObservation> observations;
  std::array<View, 2> start;
  for (int view : {0, 1}) {
    const auto& seen = detected[std::size_t(view)];
    if (!std::holds_alternative<ConeBeam>(guess.views[std::size_t(view)].projection))
      throw InputError{{viewName(view), "projection", "cone beam", projectionName(guess.views[std::size_t(view)])}};
    const auto match = matchBeads(object, seen, guess.views[std::size_t(view)], job);
    if (job.cancelled()) return cancelled;
    if (!match)
      throw InputError{{viewName(view), "beads", "a pose of '" + object.name + "' that explains the round shadows",
                        "none for " + std::to_string(seen.size()) +
                            " shadows: is it the right object, upright and whole in the image?"}};
    start[std::size_t(view)] = match->view;
    for (const auto& [bead, detection] : match->pairs)
      observations.push_back(
          {bead, view, seen[std::size_t(detection)].uv_px, seen[std::size_t(detection)].sigma_px, detection});
  }
  BeadCalibration result = calibrate(object, observations, start, options, job);
  if (result.outcome != Outcome::Converged) return result;
  for (int view : {0, 1})
    for (const auto& seen : detected[std::size_t(view)]) {
      const bool used = std::any_of(result.residuals.begin(), result.residuals.end(), [&](const BeadResidual& r) {
        const auto bead = std::find_if(object.beads.begin(), object.beads.end(),
                                       [&](const CalibrationBead& b) { return b.name == r.bead; });
        const auto uv = project(result.rig.views[std::size_t(view)], bead->p_WQ);
        return r.view == view && uv && (*uv + r.residual_px - seen.uv_px).norm() < 1e-6;
      });
      if (!used) result.unmatched_px[std::size_t(view)].push_back(seen.uv_px);
    }
  return result;
}

BeadCalibration calibrateFromSightings(const CalibrationObject& object, std::span<const Sighting> sightings,
                                       const std::array<Eigen::Vector2i, 2>& image_sizes_px,
                                       const CalibrationOptions& options, const Job& job) {
  std::vector<std::string> names;
  for (const auto& bead : object.beads) names.push_back(bead.name);
  std::vector<BeadObservation> observations;
  for (const auto& s : sightings) {
    const auto found = std::find(names.begin(), names.end(), s.name);
    if (found == names.end())
      throw InputError{
          {kWhere, "sighting", "a bead of '" + object.name + "'", "'" + s.name + "'" + didYouMean(s.name, names)}};
    observations.push_back({int(found - names.begin()), s.view, s.uv_px, s.sigma_px, -1});
  }
  std::array<View, 2> start;
  for (int view : {0, 1}) {
    requireDetermined(object, observations, view);
    std::vector<Eigen::Vector3d> places;
    std::vector<Eigen::Vector2d> uv_px;
    for (const auto& o : observations)
      if (o.view == view) {
        places.push_back(object.beads[std::size_t(o.bead)].p_WQ);
        uv_px.push_back(o.uv_px);
      }
    const auto linear = viewFromDlt(places, uv_px);
    if (!linear) throw InputError{{viewName(view), "beads", "sightings that determine a view", "a degenerate set"}};
    View& first = start[std::size_t(view)] = *linear;
    first.width_px = image_sizes_px[std::size_t(view)].x();
    first.height_px = image_sizes_px[std::size_t(view)].y();
    auto& c = std::get<ConeBeam>(first.projection);
    if (std::abs(c.fy_px / c.fx_px - 1) < 0.02) c.fy_px = c.fx_px;  // square pixels, as detectors have
  }
  return calibrate(object, observations, start, options, job);
}

}  // namespace sinew
