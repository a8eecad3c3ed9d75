#include "imaging/xray/exposure.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel_rows.h"
#include "core/random_source.h"

namespace sinew {
namespace {

constexpr double kGreyPerUnit = 1800;  ///< grey values per unit of the exponent
constexpr double kGreyOfAir = 500;
constexpr double kBodyThreshold = 0.25;  ///< an exponent above this is patient: about 12 mm of water

/// Pen strokes of a letter in a box of height 1, from the top left.
std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> strokesOf(char letter) {
  if (letter == 'L') return {{{0.05, 0.05}, {0.05, 0.95}}, {{0.05, 0.95}, {0.55, 0.95}}};
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> strokes = {{{0.05, 0.05}, {0.05, 0.95}},
                                                                      {{0.05, 0.05}, {0.32, 0.05}},
                                                                      {{0.05, 0.52}, {0.32, 0.52}},
                                                                      {{0.28, 0.52}, {0.58, 0.95}}};
  const Eigen::Vector2d center{0.32, 0.285};
  constexpr int kArc = 12;
  const auto onBowl = [&](int i) -> Eigen::Vector2d {
    const double t = std::numbers::pi * (double(i) / kArc - 0.5);
    return center + 0.235 * Eigen::Vector2d{std::cos(t), std::sin(t)};
  };
  for (int i = 0; i < kArc; ++i) strokes.emplace_back(onBowl(i), onBowl(i + 1));
  return strokes;
}

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

void addMarker(const LeadMarker& marker, const Exposure& exposure, int width, PixelField& field) {
  const int height = int(field.size()) / width;
  const auto strokes = strokesOf(marker.letter);
  constexpr double kPen = 0.075;  // half width
  const double scale = exposure.pixel_mm / marker.height_mm;
  const Eigen::Vector2d corner{marker.u_mm / marker.height_mm - 0.3, marker.v_mm / marker.height_mm - 0.5};
  const auto first = [&](double x) { return std::max(0, int((x - 0.1) / scale)); };
  for (int v = first(corner.y()); v < std::min(height, int((corner.y() + 1.1) / scale)); ++v)
    for (int u = first(corner.x()); u < std::min(width, int((corner.x() + 0.8) / scale)); ++u) {
      const Eigen::Vector2d p = Eigen::Vector2d{u + 0.5, v + 0.5} * scale - corner;
      const bool on = std::any_of(strokes.begin(), strokes.end(),
                                  [&](const auto& s) { return distanceToSegment(p, s.first, s.second) < kPen; });
      if (on) field[std::size_t(v) * std::size_t(width) + std::size_t(u)] += float(exposure.lead);
    }
}

/// Photons that every pixel absorbs: primary, scatter, and their fluctuation.
PixelField photons(const PixelField& attenuation, int width, const Exposure& exposure) {
  PixelField counts(attenuation.size());
  const float open = float(exposure.photons_per_px);
  std::transform(attenuation.begin(), attenuation.end(), counts.begin(),
                 [&](float a) { return open * std::exp(-a); });
  if (exposure.scatter_ratio > 0) {
    PixelField source(attenuation.size());  // where there is matter to scatter
    for (std::size_t i = 0; i < source.size(); ++i) source[i] = counts[i] * (1 - std::exp(-attenuation[i]));
    const PixelField scatter = broadlyBlurred(source, width, exposure.scatter_reach_mm / exposure.pixel_mm);
    for (std::size_t i = 0; i < source.size(); ++i) counts[i] += float(exposure.scatter_ratio) * scatter[i];
  }
  if (!exposure.quantum_noise) return counts;
  // Poisson by its normal approximation: no region of a usable radiograph has so few photons that it matters.
  forEachRowBand(int(counts.size()) / width, [&](RowRange rows) {
    for (int v = rows.begin; v < rows.end; ++v) {
      RandomSource random{exposure.seed, std::uint64_t(v)};
      for (int u = 0; u < width; ++u) {
        float& n = counts[std::size_t(v) * std::size_t(width) + std::size_t(u)];
        n += std::sqrt(n) * float(random.normal());
      }
    }
  });
  return counts;
}

/// Takes away a share of what varies slowly inside the patient, so that hip and ankle show in one window; the open
/// beam does not enter the average, which would leave halos along the skin, and is shown black.
void equalize(PixelField& exponent, int width, const Exposure& exposure) {
  constexpr float kMiddle = 2;  ///< where equalization changes nothing
  constexpr float kBlack = float(-kGreyOfAir / kGreyPerUnit);
  PixelField inside(exponent.size()), masked(exponent.size());
  for (std::size_t i = 0; i < exponent.size(); ++i) {
    inside[i] = std::clamp(exponent[i] / float(kBodyThreshold), 0.0F, 1.0F);
    masked[i] = inside[i] * exponent[i];
  }
  const double reach_px = exposure.equalization_reach_mm / exposure.pixel_mm;
  const PixelField sum = broadlyBlurred(masked, width, reach_px), weight = broadlyBlurred(inside, width, reach_px);
  for (std::size_t i = 0; i < exponent.size(); ++i) {
    const float mean = weight[i] > 1e-4F ? sum[i] / weight[i] : 0;
    const float shown = exponent[i] - float(exposure.equalization) * (mean - kMiddle);
    exponent[i] = inside[i] * shown + (1 - inside[i]) * kBlack;
  }
}

void closeShutter(std::vector<std::uint16_t>& pixels, int width, const Exposure& exposure) {
  const int height = int(pixels.size()) / width, margin = int(std::lround(exposure.shutter_mm / exposure.pixel_mm));
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      if (std::min({u, v - exposure.first_open_row, width - 1 - u, height - 1 - v}) < margin)
        pixels[std::size_t(v) * std::size_t(width) + std::size_t(u)] = 0;
}

}  // namespace

double greyValueOf(double attenuation) {
  return kGreyOfAir + kGreyPerUnit * attenuation;
}

Exposed expose(PixelField attenuation, int width, const Exposure& exposure) {
  for (const auto& marker : exposure.markers) addMarker(marker, exposure, width, attenuation);
  const double blur_px = exposure.blur_mm / exposure.pixel_mm;
  PixelField exponent = blurred(photons(attenuation, width, exposure), width, blur_px, blur_px);
  const float open = float(exposure.photons_per_px);
  for (float& x : exponent) x = -std::log(std::max(x, 1.0F) / open);
  const PixelField seen = exponent;
  if (exposure.equalization > 0) equalize(exponent, width, exposure);

  Exposed out;
  out.pixels.resize(exponent.size());
  std::vector<float> body;  // a sample of the patient, for the window
  const std::size_t first_seen = std::size_t(exposure.first_open_row) * std::size_t(width);
  constexpr float kWhite = float((1 << kExposedBits) - 1);
  for (std::size_t i = 0; i < exponent.size(); ++i) {
    const float grey = std::clamp(float(greyValueOf(double(exponent[i]))), 0.0F, kWhite);
    out.pixels[i] = std::uint16_t(std::lround(grey));
    if (i % 61 == 0 && seen[i] > float(kBodyThreshold) && i >= first_seen) body.push_back(grey);
  }
  if (exposure.shutter_mm > 0 || exposure.first_open_row > 0) closeShutter(out.pixels, width, exposure);
  if (body.empty()) body = {0, kWhite};
  std::sort(body.begin(), body.end());
  const auto percentile = [&](double p) { return double(body[std::size_t(p * double(body.size() - 1))]); };
  const double low = percentile(0.01), high = std::max(percentile(0.998), low + 100);
  out.window_center = (low + high) / 2;
  out.window_width = (high - low) * 1.1;
  return out;
}

}  // namespace sinew
