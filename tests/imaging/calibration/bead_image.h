#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "core/geometry/view.h"
#include "imaging/calibration/calibration_object.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew::test {

/// A disc shadow to be drawn: centre and radius in pixels.
struct Shadow {
  Eigen::Vector2d uv_px;
  double radius_px;
};

/// Shadows of the beads of an object in a view.
inline std::vector<Shadow> shadowsOf(const CalibrationObject& object, const View& view) {
  std::vector<Shadow> out;
  for (const auto& bead : object.beads) {
    const double z = (view.R_CW * bead.p_WQ + view.p_CW).z();
    out.push_back({*project(view, bead.p_WQ), 0.5 * bead.diameter_m * std::get<ConeBeam>(view.projection).fx_px / z});
  }
  return out;
}

/// A phantom radiograph: balls (chord length saturating like steel) over a slowly varying background, every pixel the
/// mean of 4 x 4 rays, Gaussian noise of `noise` grey values; balls lift the grey value by up to 12000.
inline Radiograph drawShadows(int width, int height, const std::vector<Shadow>& shadows, double noise,
                              unsigned seed) {
  std::mt19937 random{seed};
  std::normal_distribution<double> normal;
  std::vector<double> grey(std::size_t(width) * std::size_t(height));
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      grey[std::size_t(v) * std::size_t(width) + std::size_t(u)] =
          20000 + 4000 * std::sin(u * 0.002) + 3000 * std::cos(v * 0.0013) + 0.3 * u;
  for (const auto& s : shadows)
    for (int v = std::max(0, int(s.uv_px.y() - s.radius_px - 2));
         v <= std::min(height - 1.0, s.uv_px.y() + s.radius_px + 2); ++v)
      for (int u = std::max(0, int(s.uv_px.x() - s.radius_px - 2));
           u <= std::min(width - 1.0, s.uv_px.x() + s.radius_px + 2); ++u)
        for (int sub = 0; sub < 16; ++sub) {
          const Eigen::Vector2d d = Eigen::Vector2d{u + (sub % 4 - 1.5) / 4, v + (sub / 4 - 1.5) / 4} - s.uv_px;
          const double inside = 1 - d.squaredNorm() / (s.radius_px * s.radius_px);
          if (inside > 0)
            grey[std::size_t(v) * std::size_t(width) + std::size_t(u)] +=
                12000 * (1 - std::exp(-4 * std::sqrt(inside))) / 16;
        }
  std::vector<std::uint16_t> pixels;
  for (double g : grey) pixels.push_back(std::uint16_t(std::clamp(g + noise * normal(random), 0.0, 65535.0)));
  Radiograph r;
  r.width_px = width;
  r.height_px = height;
  r.pixels = std::make_shared<const std::vector<std::uint16_t>>(std::move(pixels));
  return r;
}

}  // namespace sinew::test
