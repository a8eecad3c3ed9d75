#include "imaging/rig/triangulate.h"

#include <ceres/jet.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr double kMinRayAngle_rad = 0.08726646259971647;  // 5 deg
constexpr double kGrossMismatch_sigma = 5;

/// Weighted residuals (observed minus projected, over sigma) of both sightings and their derivative by the point.
struct Linearised {
  Eigen::Vector4d residual;
  Eigen::Matrix<double, 4, 3> jacobian;
};

std::optional<Linearised> linearise(const BiplanarRig& rig, std::span<const Sighting> pair,
                                    const Eigen::Vector3d& p_W) {
  using Jet = ceres::Jet<double, 3>;
  const Vector3<Jet> p{Jet{p_W.x(), 0}, Jet{p_W.y(), 1}, Jet{p_W.z(), 2}};
  Linearised out;
  for (int i = 0; i < 2; ++i) {
    const Sighting& s = pair[std::size_t(i)];
    Eigen::Matrix<Jet, 2, 1> uv;
    if (!project<Jet>(rig.views[std::size_t(s.view)], p, uv)) return std::nullopt;
    for (int k = 0; k < 2; ++k) {
      out.residual[2 * i + k] = (s.uv_px[k] - uv[k].a) / s.sigma_px;
      out.jacobian.row(2 * i + k) = -uv[k].v.transpose() / s.sigma_px;
    }
  }
  return out;
}

/// Point halfway between two rays where they pass each other.
Eigen::Vector3d midpoint(const Ray& a, const Ray& b) {
  const Eigen::Vector3d between = b.origin_W - a.origin_W;
  const double c = a.direction_W.dot(b.direction_W), s2 = 1 - c * c;
  const double along_a = (between.dot(a.direction_W) - c * between.dot(b.direction_W)) / s2;
  const double along_b = (c * between.dot(a.direction_W) - between.dot(b.direction_W)) / s2;
  return 0.5 * (a.origin_W + along_a * a.direction_W + b.origin_W + along_b * b.direction_W);
}

struct NamedPair {
  std::string name;
  std::vector<Sighting> pair;
};

std::vector<NamedPair> groupByName(std::span<const Sighting> sightings) {
  std::vector<NamedPair> groups;
  for (const auto& s : sightings) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const NamedPair& g) { return g.name == s.name; });
    if (group == groups.end()) group = groups.insert(groups.end(), {s.name, {}});
    group->pair.push_back(s);
  }
  return groups;
}

/// Residual length in units of the picking error, the mismatch of two rays.
double mismatch_sigma(const TriangulatedLandmark& point, std::span<const Sighting> pair) {
  double sum = 0;
  for (const auto& s : pair) sum += (point.residual_px[std::size_t(s.view)] / s.sigma_px).squaredNorm();
  return std::sqrt(sum);
}

/// Median mismatch if the images of the chosen views had been counted from the bottom.
double medianMismatch_sigma(const BiplanarRig& rig, std::vector<NamedPair> pairs, bool flip_first, bool flip_second) {
  std::vector<double> values;
  for (auto& group : pairs) {
    for (auto& s : group.pair)
      if (s.view == 0 ? flip_first : flip_second)
        s.uv_px.y() = rig.views[std::size_t(s.view)].height_px - 1 - s.uv_px.y();
    const auto point = triangulate(rig, group.pair);
    values.push_back(point ? mismatch_sigma(*point, group.pair) : std::numeric_limits<double>::infinity());
  }
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// A sighting that was counted from the bottom row misses its partner by hundreds of pixels; when all of them agree
/// again after flipping, the convention is wrong and not the picks.
void warnOfFlippedRows(const BiplanarRig& rig, const std::vector<NamedPair>& pairs, Warnings& warnings) {
  if (pairs.size() < 3) return;  // fewer agree by chance
  const double as_given = medianMismatch_sigma(rig, pairs, false, false);
  if (as_given <= kGrossMismatch_sigma) return;
  struct Case {
    bool first, second;
    const char* views;
  };
  constexpr Case kCases[] = {{true, true, "both views"}, {true, false, "view 1"}, {false, true, "view 2"}};
  const char* best_views = nullptr;
  double best = as_given / 5;
  for (const auto& c : kCases) {
    const double flipped = medianMismatch_sigma(rig, pairs, c.first, c.second);
    if (flipped < best) best = flipped, best_views = c.views;
  }
  if (best_views)
    warnings.push_back({"flipped_y", std::string{"The sightings of "} + best_views +
                                         " fit only if v is counted upwards from the bottom row: another y "
                                         "convention; expected v downwards from the top row."});
}

/// Picks that meet only after trading places belong to the other view.
void warnOfSwappedViews(const BiplanarRig& rig, const std::vector<NamedPair>& pairs, Warnings& warnings) {
  if (pairs.size() < 3) return;
  const double as_given = medianMismatch_sigma(rig, pairs, false, false);
  if (as_given <= kGrossMismatch_sigma) return;
  auto swapped = pairs;
  for (auto& group : swapped)
    for (auto& s : group.pair) s.view = 1 - s.view;
  if (medianMismatch_sigma(rig, swapped, false, false) < as_given / 5)
    warnings.push_back({"swapped_views", "The sightings fit only if view 1 and view 2 are exchanged."});
}

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

}  // namespace

std::optional<TriangulatedLandmark> triangulate(const BiplanarRig& rig, std::span<const Sighting> pair) {
  if (pair.size() != 2 || pair[0].view + pair[1].view != 1 || pair[0].view * pair[1].view != 0)
    throw InputError{{"triangulate", pair.empty() ? "" : pair[0].name, "one sighting in each of the two views",
                      std::to_string(pair.size()) + " sightings"}};
  std::array<Ray, 2> rays;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!(pair[i].sigma_px > 0) || !pair[i].uv_px.allFinite())
      throw InputError{{"triangulate", pair[i].name, "finite u_px, v_px and sigma_px > 0", "other numbers"}};
    rays[i] = backProject(rig.views[std::size_t(pair[i].view)], pair[i].uv_px);
  }
  if (rays[0].direction_W.cross(rays[1].direction_W).norm() < std::sin(kMinRayAngle_rad)) return std::nullopt;

  Eigen::Vector3d p_W = midpoint(rays[0], rays[1]);
  std::optional<Linearised> at = linearise(rig, pair, p_W);
  for (int iteration = 0; at && iteration < 50; ++iteration) {
    const Eigen::Vector3d step = -at->jacobian.colPivHouseholderQr().solve(at->residual);
    p_W += step;
    at = linearise(rig, pair, p_W);
    if (step.norm() < 1e-13 * (1 + p_W.norm())) break;
  }
  if (!at) return std::nullopt;  // the rays meet behind a source: no such point exists

  TriangulatedLandmark point{pair[0].name, p_W, (at->jacobian.transpose() * at->jacobian).inverse(), 0, {}};
  double sum_px2 = 0;
  for (int i = 0; i < 2; ++i) {
    const Sighting& s = pair[std::size_t(i)];
    point.residual_px[std::size_t(s.view)] = at->residual.segment<2>(2 * i) * s.sigma_px;
    sum_px2 += point.residual_px[std::size_t(s.view)].squaredNorm();
  }
  point.reprojection_rms_px = std::sqrt(sum_px2 / 2);
  return point;
}

Triangulation triangulateAll(const BiplanarRig& rig, std::span<const Sighting> sightings) {
  Triangulation result;
  std::vector<NamedPair> pairs;
  for (auto& group : groupByName(sightings)) {
    if (group.pair.size() == 2 && group.pair[0].view != group.pair[1].view)
      pairs.push_back(group);
    else
      result.warnings.push_back(
          {"seen_once", "'" + group.name + "' is seen in one view only: no position in space."});
  }
  double sum_px2 = 0;
  for (const auto& group : pairs) {
    const auto point = triangulate(rig, group.pair);
    if (!point) {
      result.warnings.push_back({"rays_nearly_parallel", "'" + group.name +
                                                             "': the two rays are nearly parallel or meet behind a "
                                                             "source; its depth is not determined."});
      continue;
    }
    const double mismatch = mismatch_sigma(*point, group.pair);
    if (mismatch > kGrossMismatch_sigma)
      result.warnings.push_back({"gross_mismatch", "'" + group.name + "': the two sightings miss each other by " +
                                                       shortNumber(point->reprojection_rms_px) + " px (" +
                                                       shortNumber(mismatch) +
                                                       " times the picking error): not the same point?"});
    sum_px2 += point->reprojection_rms_px * point->reprojection_rms_px;
    result.points.push_back(*point);
  }
  if (!result.points.empty()) result.rms_px = std::sqrt(sum_px2 / double(result.points.size()));
  warnOfFlippedRows(rig, pairs, result.warnings);
  warnOfSwappedViews(rig, pairs, result.warnings);
  return result;
}

}  // namespace sinew
