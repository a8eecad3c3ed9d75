#include "app/scene/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace sinew {

Rgb interpolatedColour(std::span<const Rgb> stops, double t) {
  const double x = std::clamp(std::isfinite(t) ? t : 0.0, 0.0, 1.0) * double(stops.size() - 1);
  const auto i = std::min(std::size_t(x), stops.size() - 2);
  const double s = x - double(i);
  const Rgb &a = stops[i], &b = stops[i + 1];
  return {a.r + s * (b.r - a.r), a.g + s * (b.g - a.g), a.b + s * (b.b - a.b)};
}

Rgb sequentialColour(double t) {
  static constexpr std::array kStops = {Rgb{0.26, 0.22, 0.60}, Rgb{0.16, 0.40, 0.60}, Rgb{0.16, 0.55, 0.55},
                                        Rgb{0.45, 0.71, 0.36}, Rgb{0.96, 0.89, 0.30}};
  return interpolatedColour(kStops, t);
}

Rgb divergingColour(double t) {
  static constexpr std::array kStops = {Rgb{0.02, 0.28, 0.58}, Rgb{0.45, 0.67, 0.85}, Rgb{0.94, 0.94, 0.92},
                                        Rgb{0.93, 0.63, 0.32}, Rgb{0.62, 0.26, 0.02}};
  return interpolatedColour(kStops, t);
}

Rgb groupColour(std::string_view group) {
  using namespace palette;
  static constexpr std::array kColours = {kVermilion, kSkyBlue, kGreen, kOrange, kPurple, kBlue, kYellow};
  std::uint32_t hash = 2166136261u;  // FNV-1a: the same on every machine
  for (const char c : group) hash = (hash ^ std::uint8_t(c)) * 16777619u;
  const Rgb base = kColours[hash % kColours.size()];
  const double shade = 0.78 + 0.11 * double((hash >> 8) % 3);  // groups of one hue still differ in lightness
  return {base.r * shade, base.g * shade, base.b * shade};
}

}  // namespace sinew
