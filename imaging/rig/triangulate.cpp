#include "imaging/rig/triangulate.h"

#include <ceres/jet.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "imaging/rig/sighting_groups_internal.h"

namespace sinew {
namespace {

constexpr double kMinRayAngle_rad = 0.08726646259971647;  // 5 deg

/// Weighted residuals (observed minus projected, over sigma) of all sightings and their derivative by the point.
struct Linearised {
  Eigen::VectorXd residual;
  Eigen::Matrix<double, Eigen::Dynamic, 3> jacobian;
};

std::optional<Linearised> linearise(const BiplanarRig& rig, std::span<const Sighting> sightings,
                                    const Eigen::Vector3d& p_W) {
  using Jet = ceres::Jet<double, 3>;
  const Vector3<Jet> p{Jet{p_W.x(), 0}, Jet{p_W.y(), 1}, Jet{p_W.z(), 2}};
  const Eigen::Index rows = 2 * Eigen::Index(sightings.size());
  Linearised out{Eigen::VectorXd(rows), Eigen::Matrix<double, Eigen::Dynamic, 3>(rows, 3)};
  Eigen::Index row = 0;
  for (const Sighting& s : sightings) {
    Eigen::Matrix<Jet, 2, 1> uv;
    if (!project<Jet>(rig.views[std::size_t(s.view)], p, uv)) return std::nullopt;
    for (int k = 0; k < 2; ++k, ++row) {
      out.residual[row] = (s.uv_px[k] - uv[k].a) / s.sigma_px;
      out.jacobian.row(row) = -uv[k].v.transpose() / s.sigma_px;
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

/// Where the two rays nearest to a right angle pass each other; nullopt if all are nearly parallel.
std::optional<Eigen::Vector3d> startOf(const BiplanarRig& rig, std::span<const Sighting> sightings) {
  std::vector<Ray> rays;
  for (const Sighting& s : sightings) rays.push_back(backProject(rig.views[std::size_t(s.view)], s.uv_px));
  double widest = std::sin(kMinRayAngle_rad);
  std::optional<Eigen::Vector3d> start;
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t k = i + 1; k < rays.size(); ++k) {
      const double sine = rays[i].direction_W.cross(rays[k].direction_W).norm();
      if (sine < widest) continue;
      widest = sine;
      start = midpoint(rays[i], rays[k]);
    }
  return start;
}

void requireUsable(const BiplanarRig& rig, std::span<const Sighting> sightings) {
  const std::string name = sightings.empty() ? std::string{} : sightings[0].name;
  for (const Sighting& s : sightings) {
    requireKnownView(rig, s);
    if (!(s.sigma_px > 0) || !s.uv_px.allFinite())
      throw InputError{{"triangulate", s.name, "finite u_px, v_px and sigma_px > 0", "other numbers"}};
  }
  if (sightings.size() < 2 || !inDifferentViews(sightings))
    throw InputError{{"triangulate", name, "one sighting in each of two or more views",
                      std::to_string(sightings.size()) + " sightings"}};
}

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

/// Of three and more sightings, the one without which the others agree; -1 if there is none.
int viewThatDisagrees(const BiplanarRig& rig, const SightingGroup& group) {
  if (group.sightings.size() < 3) return -1;
  for (std::size_t i = 0; i < group.sightings.size(); ++i) {
    auto others = group.sightings;
    others.erase(others.begin() + long(i));
    const auto point = triangulate(rig, others);
    if (point && mismatch_sigma(*point, others) <= grossMismatch_sigma(others.size())) return group.sightings[i].view;
  }
  return -1;
}

void warnOfMismatch(const BiplanarRig& rig, const SightingGroup& group, const TriangulatedLandmark& point,
                    Warnings& warnings) {
  const double mismatch = mismatch_sigma(point, group.sightings);
  if (mismatch <= grossMismatch_sigma(group.sightings.size())) return;
  const int view = viewThatDisagrees(rig, group);
  const std::string who = group.sightings.size() == 2 ? "the two sightings miss each other by "
                          : view < 0                  ? "the sightings miss each other by "
                                     : "the sighting in view " + std::to_string(view + 1) + " misses the others by ";
  warnings.push_back({"gross_mismatch", "'" + group.name + "': " + who + shortNumber(point.reprojection_rms_px) +
                                            " px (" + shortNumber(mismatch) +
                                            " times the picking error): not the same point?"});
}

/// Names that have a place in space; warns of the others.
std::vector<SightingGroup> seenInSpace(const BiplanarRig& rig, std::span<const Sighting> sightings,
                                       Warnings& warnings) {
  std::vector<SightingGroup> groups;
  for (auto& group : groupByName(sightings)) {
    for (const auto& s : group.sightings) requireKnownView(rig, s);
    if (group.sightings.size() == 1)
      warnings.push_back({"seen_once", "'" + group.name + "' is seen in one view only: no position in space."});
    else if (!inDifferentViews(group.sightings))
      warnings.push_back({"seen_twice", "'" + group.name + "' is picked twice in one view: no position in space."});
    else
      groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

const Eigen::Vector2d* TriangulatedLandmark::residualIn(int view) const {
  const auto found = std::ranges::find(residuals, view, &ViewResidual::view);
  return found == residuals.end() ? nullptr : &found->residual_px;
}

std::optional<TriangulatedLandmark> triangulate(const BiplanarRig& rig, std::span<const Sighting> sightings) {
  requireUsable(rig, sightings);
  const auto start = startOf(rig, sightings);
  if (!start) return std::nullopt;
  Eigen::Vector3d p_W = *start;
  std::optional<Linearised> at = linearise(rig, sightings, p_W);
  for (int iteration = 0; at && iteration < 50; ++iteration) {
    const Eigen::Vector3d step = -at->jacobian.colPivHouseholderQr().solve(at->residual);
    p_W += step;
    at = linearise(rig, sightings, p_W);
    if (step.norm() < 1e-13 * (1 + p_W.norm())) break;
  }
  if (!at) return std::nullopt;  // the rays meet behind a source: no such point exists

  const Eigen::Matrix3d normal = at->jacobian.transpose() * at->jacobian;
  TriangulatedLandmark point{sightings[0].name, p_W, normal.inverse(), 0, {}};
  double sum_px2 = 0;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Sighting& s = sightings[i];
    point.residuals.push_back({s.view, at->residual.segment<2>(2 * Eigen::Index(i)) * s.sigma_px});
    sum_px2 += point.residuals.back().residual_px.squaredNorm();
  }
  point.reprojection_rms_px = std::sqrt(sum_px2 / double(sightings.size()));
  return point;
}

Triangulation triangulateAll(const BiplanarRig& rig, std::span<const Sighting> sightings) {
  Triangulation result;
  const auto groups = seenInSpace(rig, sightings, result.warnings);
  double sum_px2 = 0;
  for (const auto& group : groups) {
    const auto point = triangulate(rig, group.sightings);
    if (!point) {
      result.warnings.push_back({"rays_nearly_parallel", "'" + group.name +
                                                             "': its rays are nearly parallel or meet behind a "
                                                             "source; its depth is not determined."});
      continue;
    }
    warnOfMismatch(rig, group, *point, result.warnings);
    sum_px2 += point->reprojection_rms_px * point->reprojection_rms_px;
    result.points.push_back(*point);
  }
  if (!result.points.empty()) result.rms_px = std::sqrt(sum_px2 / double(result.points.size()));
  warnOfFlippedRows(rig, groups, result.warnings);
  warnOfSwappedViews(rig, groups, result.warnings);
  return result;
}

}  // namespace sinew
