#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "core/skeleton/fit/fit_report_internal.h"
#include "core/text.h"

namespace sinew {
namespace {

std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

void requireUsable(const LandmarkObservation& o, std::size_t view_count) {
  if (o.view < 0 || o.view >= static_cast<int>(view_count))
    throw InputError{{"sightings", o.landmark, "a view from 1 to " + std::to_string(view_count),
                      "view " + std::to_string(o.view + 1)}};
  if (!o.uv_px.allFinite() || !(o.sigma_px > 0) || !std::isfinite(o.sigma_px))
    throw InputError{{"sightings", o.landmark, "finite pixel coordinates and sigma > 0", "something else"}};
}

void warnOfLandmarksSeenOnce(const SightingList& list, std::size_t view_count, Warnings& warnings) {
  if (view_count < 2) return;
  std::map<std::string, std::set<int>> views_of;
  for (const auto& s : list.items) views_of[s.landmark].insert(s.view);
  std::string names;
  for (const auto& [name, seen] : views_of)
    if (seen.size() == 1) names += (names.empty() ? "" : ", ") + name;
  if (!names.empty())
    warnings.push_back({"landmark_seen_once", "seen in one view only, used with less weight on depth: " + names});
}

}  // namespace

SightingList usableSightings(const Skeleton& reference, std::size_t view_count,
                             std::span<const LandmarkObservation> observations) {
  std::vector<std::string> known;
  for (const auto& landmark : reference.landmarks) known.push_back(landmark.name);
  SightingList list;
  std::map<int, int> point_of;
  std::set<std::string> complained;
  for (const auto& o : observations) {
    requireUsable(o, view_count);
    const auto at = std::ranges::find(known, o.landmark);
    const bool first = complained.insert(o.landmark).second;
    if (at == known.end()) {
      if (first)
        list.warnings.push_back({"landmark_unknown", "'" + o.landmark + "' is no landmark of the skeleton" +
                                                         didYouMean(o.landmark, known)});
      continue;
    }
    const int index = static_cast<int>(at - known.begin());
    if (reference.landmarks[index].segment >= reference.movingSegmentCount()) {
      if (first)
        list.warnings.push_back({"landmark_not_fitted", "'" + o.landmark +
                                                            "' lies on a bone that glides with a joint (patella, "
                                                            "radius); the fit does not use it"});
      continue;
    }
    const auto [place, added] = point_of.try_emplace(index, static_cast<int>(list.landmarks.size()));
    if (added) list.landmarks.push_back(index);
    list.items.push_back({o.landmark, place->second, o.view, o.uv_px, o.sigma_px});
  }
  if (list.items.empty())
    throw InputError{{"sightings", "", "at least one landmark of the skeleton, such as femoral_head_center_r",
                      observations.empty() ? "none" : list.warnings.front().message}};
  warnOfLandmarksSeenOnce(list, view_count, list.warnings);
  return list;
}

void describeResiduals(const SightingList& sightings, SkeletonFit& fit) {
  double sum_px2 = 0;
  for (const auto& residual : fit.residuals) sum_px2 += residual.residual_px.squaredNorm();
  fit.rms_px = std::sqrt(sum_px2 / static_cast<double>(fit.residuals.size()));

  std::vector<std::size_t> worst;
  constexpr double kDoubtful_sigma = 5;
  for (std::size_t i = 0; i < fit.residuals.size(); ++i)
    if (fit.residuals[i].sigmas > kDoubtful_sigma || sightings.items[i].left_out) worst.push_back(i);
  std::ranges::sort(worst, [&](auto a, auto b) { return fit.residuals[a].sigmas > fit.residuals[b].sigmas; });
  // Single slips stay few; so many disagree when the picks as a whole are of another body, and that is said first.
  if (4 * worst.size() > fit.residuals.size())
    fit.warnings.push_back(
        {"picks_disagree", std::to_string(worst.size()) + " of " + std::to_string(fit.residuals.size()) +
                               " picks fit no body: are left and right exchanged, an image mirrored, or the views "
                               "not of one posture? The figures are not to be used"});
  for (const std::size_t i : worst) {
    const LandmarkResidual& r = fit.residuals[i];
    fit.warnings.push_back({"outlier", r.landmark + " in view " + std::to_string(r.view + 1) + " lies " +
                                           rounded(r.residual_px.norm()) + " px (" + rounded(r.sigmas) +
                                           " sigma) from the fitted bone" +
                                           (sightings.items[i].left_out ? " and was left out" : "")});
  }

  constexpr double kDoubtful = 1.5;
  if (fit.pick_scale.pick > kDoubtful)
    fit.warnings.push_back(
        {"residuals_exceed_sigma",
         "the picks scatter " + rounded(fit.pick_scale.pick) +
             " times as much as stated, after movement and geometry were allowed for: are the views "
             "of one patient, and the geometry theirs? The intervals are widened by that factor"});
}

std::vector<bool> undeterminedUnknowns(const BodyParameters& body, const Eigen::MatrixXd& covariance, double ratio) {
  std::vector<bool> undetermined(body.count());
  for (int i = 0; i < body.count(); ++i)
    undetermined[i] = body.hasPrior(i) && std::sqrt(covariance(i, i)) * body.priorWeight(i) > ratio;
  return undetermined;
}

std::vector<std::string> namesOf(const Skeleton& reference, const BodyParameters& body,
                                 const Eigen::MatrixXd& covariance, double ratio) {
  const auto undetermined = undeterminedUnknowns(body, covariance, ratio);
  std::vector<std::string> names;
  for (int i = 0; i < body.shapeCount(); ++i)
    if (undetermined[BodyParameters::kShapeBegin + i]) names.push_back(shapeParameterNames()[i]);
  for (const auto& joint : reference.joints) {
    const int first = body.postureBegin() + joint.first_coordinate;
    for (int k = 0; k < joint.coordinate_count; ++k) {
      const Coordinate& coordinate = reference.coordinates[joint.first_coordinate + k];
      if (joint.type != JointType::Ball && !(joint.type == JointType::Free && k >= 3)) {
        if (undetermined[first + k]) names.push_back(coordinate.name);
        continue;
      }
      const int r = first + (joint.type == JointType::Free ? 3 : 0);
      Eigen::Vector3d axis = coordinate.axis, prior_variance;
      for (int c = 0; c < 3; ++c) {
        axis[c] *= body.sd(r + c);
        prior_variance[c] = 1 / std::pow(body.priorWeight(r + c), 2);
      }
      const double variance = axis.dot(covariance.block<3, 3>(r, r) * axis);
      if (variance > ratio * ratio * axis.cwiseAbs2().dot(prior_variance)) names.push_back(coordinate.name);
    }
  }
  return names;
}

void warnOfBounds(const BodyParameters& body, const Eigen::VectorXd& z, Warnings& warnings) {
  std::string names;
  for (int i = 0; i < body.shapeCount(); ++i) {
    const int k = BodyParameters::kShapeBegin + i;
    if (z[k] < body.lower(k) + 1e-6 || z[k] > body.upper(k) - 1e-6)
      names += (names.empty() ? "" : ", ") + shapeParameterNames()[i];
  }
  if (!names.empty())
    warnings.push_back(
        {"parameter_at_bound", "at the limit of plausible shapes, check sightings and geometry: " + names});
}

}  // namespace sinew
