#pragma once
#include <array>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/skeleton/fit/fit_skeleton.h"
#include "core/skeleton/kinematics.h"
#include "core/skeleton/shape/bone_field.h"

namespace sinew::test {

/// Axes of a view given by where u, v and the beam point in the world; the origin of the view frame at `p_WC`.
inline void placeView(View& view, const Eigen::Vector3d& u_W, const Eigen::Vector3d& v_W,
                      const Eigen::Vector3d& p_WC) {
  view.R_CW << u_W.transpose(), v_W.transpose(), u_W.cross(v_W).transpose();
  view.p_CW = -view.R_CW * p_WC;
}

/// A standing pair of cone-beam radiographs, frontal (antero-posterior) and lateral, of pelvis and legs: source 1.7 m
/// from the body, 2 m from a detector of 0.2 mm pixels; 5.9 px per mm in the plane of the body.
inline std::vector<View> coneBeamPair() {
  const Eigen::Vector3d center{0, 0.55, 0};
  std::vector<View> views(2);
  for (auto& view : views) {
    view.projection = ConeBeam{.fx_px = 10000, .fy_px = 10000, .cx_px = 1500, .cy_px = 3500};
    view.width_px = 3000;
    view.height_px = 7000;
  }
  placeView(views[0], -Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY(), center + 1.7 * Eigen::Vector3d::UnitX());
  placeView(views[1], -Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(), center - 1.7 * Eigen::Vector3d::UnitZ());
  return views;
}

/// A slot-scanner pair: isocentre 0.987 m from the sources, pixels of 0.186 mm in its plane.
inline std::vector<View> slotScanPair() {
  std::vector<View> views = coneBeamPair();
  for (auto& view : views)
    view.projection = SlotScan{.source_to_isocenter_m = 0.987,
                               .column_spacing_m = 0.000186,
                               .row_spacing_m = 0.000186,
                               .u0_px = 1500,
                               .v0_px = 3500};
  const Eigen::Vector3d center{0, 0.55, 0};
  placeView(views[0], -Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY(), center);
  placeView(views[1], -Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(), center);
  return views;
}

/// Where the landmarks of `body` appear in the views, with Gaussian picking noise of `noise_mm` in the plane of the
/// body. The stated sigma is that noise, or 0.05 px if there is none.
inline std::vector<LandmarkObservation> observe(const Skeleton& body, const Posture& posture,
                                                std::span<const View> views, std::span<const std::string> landmarks,
                                                double noise_mm, std::mt19937_64& random) {
  const auto X_WB = segmentPoses(body, posture);
  std::normal_distribution<double> normal;
  std::vector<LandmarkObservation> observations;
  for (const auto& name : landmarks) {
    const Landmark& landmark = body.landmark(name);
    const Eigen::Vector3d p_W = X_WB[landmark.segment] * landmark.p_BL;
    for (int view = 0; view < static_cast<int>(views.size()); ++view) {
      const double sigma_px = noise_mm * pixelsPerMillimetre(views[view], p_W);
      Eigen::Vector2d uv_px = *project(views[view], p_W);
      for (double& coordinate : uv_px) coordinate += sigma_px * normal(random);
      observations.push_back({name, view, uv_px, sigma_px > 0 ? sigma_px : 0.05});
    }
  }
  return observations;
}
/// The same of the reference's body of this shape.
inline std::vector<LandmarkObservation> observe(const Skeleton& reference, const ShapeParameters& shape,
                                                const Posture& posture, std::span<const View> views,
                                                std::span<const std::string> landmarks, double noise_mm,
                                                std::mt19937_64& random) {
  return observe(deformedSkeleton(reference, shape), posture, views, landmarks, noise_mm, random);
}

}  // namespace sinew::test
