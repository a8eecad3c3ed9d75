#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/skeleton/fit/fit_start_internal.h"

namespace sinew {
namespace {

/// Midpoint of the shortest segment between two rays; nullopt within 3 deg of parallel.
std::optional<Eigen::Vector3d> midpoint(const Ray& a, const Ray& b) {
  const Eigen::Vector3d gap = b.origin_W - a.origin_W;
  const double cosine = a.direction_W.dot(b.direction_W), determinant = 1 - cosine * cosine;
  constexpr double kSine2OfThreeDegrees = 0.0027;
  if (determinant < kSine2OfThreeDegrees) return std::nullopt;
  const double along_a = gap.dot(a.direction_W), along_b = gap.dot(b.direction_W);
  const double s = (along_a - cosine * along_b) / determinant, t = (cosine * along_a - along_b) / determinant;
  return 0.5 * (a.origin_W + s * a.direction_W + b.origin_W + t * b.direction_W);
}

std::optional<Similarity> alignWeighted(std::span<const Eigen::Vector3d> body, std::span<const Eigen::Vector3d> world,
                                        const Eigen::VectorXd& weights) {
  const double total = weights.sum();
  Eigen::Vector3d mean_b = Eigen::Vector3d::Zero(), mean_w = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < body.size(); ++i) {
    mean_b += weights[i] / total * body[i];
    mean_w += weights[i] / total * world[i];
  }
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero(), spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Eigen::Vector3d b = body[i] - mean_b, w = world[i] - mean_w;
    cross += weights[i] * w * b.transpose();
    spread += weights[i] * b * b.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd{cross, Eigen::ComputeFullU | Eigen::ComputeFullV};
  if (svd.singularValues()[1] < 1e-6 * svd.singularValues()[0]) return std::nullopt;  // on one line
  Eigen::Vector3d sign{1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0};
  Similarity s;
  s.R = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  s.scale = svd.singularValues().dot(sign) / spread.trace();
  s.t = mean_w - s.scale * s.R * mean_b;
  return s;
}

/// The 24 orientations that turn axes into axes, and each again turned by 45 deg about the vertical.
std::vector<Eigen::Matrix3d> orientations() {
  std::vector<Eigen::Matrix3d> list;
  const std::array<Eigen::Vector3d, 6> directions = {Eigen::Vector3d::UnitX(),  Eigen::Vector3d::UnitY(),
                                                     Eigen::Vector3d::UnitZ(),  -Eigen::Vector3d::UnitX(),
                                                     -Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ()};
  const Eigen::Matrix3d eighth = Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitY()).toRotationMatrix();
  for (const auto& x : directions)
    for (const auto& y : directions) {
      if (std::abs(x.dot(y)) > 0.5) continue;
      Eigen::Matrix3d R;
      R << x, y, x.cross(y);
      list.push_back(R);
      list.push_back(R * eighth);
    }
  return list;
}

/// Sum of residuals that saturate: how badly the body stands there.
double misfit(const Similarity& s, std::span<const Eigen::Vector3d> body, std::span<const View> views,
              std::span<const StartSighting> sightings) {
  double sum = 0;
  for (const auto& sighting : sightings) {
    const auto uv = project(views[sighting.view], Eigen::Vector3d{s.scale * s.R * body[sighting.point] + s.t});
    if (!uv) return std::numeric_limits<double>::infinity();
    sum += std::log1p((*uv - sighting.uv_px).norm() / sighting.sigma_px);
  }
  return sum;
}

}  // namespace

std::optional<Similarity> alignPoints(std::span<const Eigen::Vector3d> body, std::span<const Eigen::Vector3d> world) {
  if (body.size() < 3) return std::nullopt;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(body.size()));
  std::optional<Similarity> best;
  constexpr int kRounds = 15;
  for (int round = 0; round < kRounds; ++round) {
    const auto s = alignWeighted(body, world, weights);
    if (!s) return best;
    best = s;
    std::vector<double> distances;
    for (std::size_t i = 0; i < body.size(); ++i)
      distances.push_back((s->scale * s->R * body[i] + s->t - world[i]).norm());
    auto sorted = distances;
    std::ranges::nth_element(sorted, sorted.begin() + static_cast<long>(sorted.size() / 2));
    const double typical = std::max(sorted[sorted.size() / 2], 1e-6);
    for (std::size_t i = 0; i < body.size(); ++i) weights[i] = 1 / (1 + std::pow(distances[i] / typical, 2));
  }
  return best;
}

std::optional<Similarity> similarityOf(std::span<const Eigen::Vector3d> body,
                                       std::span<const Eigen::Vector3d> world) {
  if (body.size() < 3) return std::nullopt;
  return alignWeighted(body, world, Eigen::VectorXd::Ones(static_cast<Eigen::Index>(body.size())));
}

Similarity startOfFit(std::span<const Eigen::Vector3d> body, std::span<const View> views,
                      std::span<const StartSighting> sightings, double scale_guess) {
  std::vector<Eigen::Vector3d> seen_body, seen_world;
  for (std::size_t i = 0; i < sightings.size(); ++i)
    for (std::size_t k = i + 1; k < sightings.size(); ++k) {
      const auto &a = sightings[i], &b = sightings[k];
      if (a.point != b.point || a.view == b.view) continue;
      const auto p = midpoint(backProject(views[a.view], a.uv_px), backProject(views[b.view], b.uv_px));
      if (!p) continue;
      seen_body.push_back(body[a.point]);
      seen_world.push_back(*p);
    }
  if (const auto aligned = alignPoints(seen_body, seen_world);
      aligned && aligned->scale > 0 && std::isfinite(misfit(*aligned, body, views, sightings)))
    return *aligned;

  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const auto& sighting : sightings) center += body[sighting.point] / static_cast<double>(sightings.size());
  Eigen::Vector2d uv_px = Eigen::Vector2d::Zero();
  double in_view = 0;
  for (const auto& sighting : sightings)
    if (sighting.view == sightings.front().view) {
      uv_px += sighting.uv_px;
      ++in_view;
    }
  const Ray ray = backProject(views[sightings.front().view], uv_px / in_view);
  Similarity best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& R : orientations())
    for (double distance_m = 0.4; distance_m < 4; distance_m *= 1.15) {
      Similarity s{scale_guess, R, Eigen::Vector3d::Zero()};
      s.t = ray.origin_W + distance_m * ray.direction_W - s.scale * R * center;
      const double sum = misfit(s, body, views, sightings);
      if (sum < least) {
        least = sum;
        best = s;
      }
    }
  return best;
}

}  // namespace sinew
