#include "app/scene/muscle_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew {
namespace {

constexpr int kSamples = 22;
constexpr double kTendonRadius_m = 0.0016, kMinBellyRadius_m = 0.0030, kMaxBellyRadius_m = 0.0130;
constexpr double kSpecificTension_Npm2 = 60e4;

std::vector<double> arcLengths(const std::vector<Eigen::Vector3d>& path) {
  std::vector<double> s{0};
  for (std::size_t i = 1; i < path.size(); ++i) s.push_back(s.back() + (path[i] - path[i - 1]).norm());
  return s;
}

double bellyRadius_m(const MusculotendonUnit& unit) {
  const double area_m2 = unit.max_isometric_force_N / kSpecificTension_Npm2;
  return std::clamp(0.5 * std::sqrt(area_m2 / std::numbers::pi), kMinBellyRadius_m, kMaxBellyRadius_m);
}

}  // namespace

MuscleSpindle muscleSpindle(const MusculotendonUnit& unit, const std::vector<Eigen::Vector3d>& path) {
  MuscleSpindle spindle;
  if (path.size() < 2) return spindle;
  const auto at_corner = arcLengths(path);
  const double length = at_corner.back();
  if (!(length > 0)) return spindle;

  std::vector<double> stations = at_corner;
  for (int i = 1; i < kSamples; ++i) stations.push_back(length * i / kSamples);
  std::ranges::sort(stations);
  const double closest = 0.2 * length / kSamples;  // tubes fold where stations nearly coincide
  const auto repeated =
      std::unique(stations.begin(), stations.end(), [&](double a, double b) { return b - a < closest; });
  stations.erase(repeated, stations.end());
  stations.back() = length;

  const double belly = std::clamp(1.8 * unit.optimal_fiber_length_m, 0.4 * length, 0.96 * length);
  const double radius_m = bellyRadius_m(unit);
  std::size_t edge = 0;
  for (const double s : stations) {
    while (edge + 2 < path.size() && s > at_corner[edge + 1]) ++edge;
    const double run = at_corner[edge + 1] - at_corner[edge];
    const double t = run > 0 ? (s - at_corner[edge]) / run : 0;
    spindle.points.push_back(path[edge] + t * (path[edge + 1] - path[edge]));
    const double x = std::clamp((s - length / 2) / (belly / 2), -1.0, 1.0);
    const double bulge = std::pow(std::cos(x * std::numbers::pi / 2), 2);
    spindle.radius_m.push_back(kTendonRadius_m + bulge * (radius_m - kTendonRadius_m));
  }
  return spindle;
}

}  // namespace sinew
