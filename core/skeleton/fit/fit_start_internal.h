#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/view.h"

namespace sinew {

/// One sighting of a point of a rigid body in the zero posture.
struct StartSighting {
  int point = 0;  ///< index into the body's points
  int view = 0;
  Eigen::Vector2d uv_px;
  double sigma_px = 1;
};

/// Similarity that takes the body's points to the world: p_W = scale * R * p + t.
struct Similarity {
  double scale = 1;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

/// Least-squares similarity between corresponding points (Umeyama 1991), re-weighted so that a few gross errors do
/// not count. nullopt for fewer than three points or points on one line.
std::optional<Similarity> alignPoints(std::span<const Eigen::Vector3d> body, std::span<const Eigen::Vector3d> world);

/// The same without re-weighting: the plain least-squares similarity.
std::optional<Similarity> similarityOf(std::span<const Eigen::Vector3d> body, std::span<const Eigen::Vector3d> world);

/// Where the patient stands, for the start of the fit. From the midpoints between the rays of points that two views
/// show; if there are too few, the best of a coarse search over orientations and distances along the rays.
/// `scale_guess` is the size that the search assumes.
Similarity startOfFit(std::span<const Eigen::Vector3d> body, std::span<const View> views,
                      std::span<const StartSighting> sightings, double scale_guess);

}  // namespace sinew
