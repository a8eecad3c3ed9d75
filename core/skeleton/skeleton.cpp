#include "core/skeleton/skeleton.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace sinew {
namespace {

template <class Items>
int indexByName(const Items& items, std::string_view name, const char* kind) {
  const auto found = std::ranges::find(items, name, [](const auto& item) -> std::string_view { return item.name; });
  if (found != items.end()) return static_cast<int>(found - items.begin());
  std::vector<std::string> known;
  for (const auto& item : items) known.push_back(item.name);
  throw InputError{{kind, "", "a known name", "'" + std::string{name} + "'" + didYouMean(name, known)}};
}

}  // namespace

std::array<double, 2> PatellaDriver::glide(double flexion_rad) const {
  // Integral of the piecewise linear arm; beyond its ends the arm stays constant, so that phi is C1 everywhere.
  const auto& x = knee_flexion_rad;
  const auto& r = quadriceps_arm_m;
  if (flexion_rad <= x.front())
    return {(flexion_rad - x.front()) * r.front() / reference_radius_m, r.front() / reference_radius_m};
  double integral = 0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double span = x[i + 1] - x[i];
    const double t = std::min(flexion_rad - x[i], span);
    const double end = r[i] + (r[i + 1] - r[i]) * t / span;
    integral += t * (r[i] + end) / 2;
    if (flexion_rad <= x[i + 1]) return {integral / reference_radius_m, end / reference_radius_m};
  }
  integral += (flexion_rad - x.back()) * r.back();
  return {integral / reference_radius_m, r.back() / reference_radius_m};
}

RigidTransform mirrored(const RigidTransform& X) {
  const Eigen::Vector3d flip{1, 1, -1};
  RigidTransform Y = RigidTransform::Identity();
  Y.translation() = mirrored(X.translation());
  Y.linear() = flip.asDiagonal() * X.linear() * flip.asDiagonal();
  return Y;
}

int Skeleton::segmentIndex(std::string_view name) const {
  return indexByName(segments, name, "segment");
}
int Skeleton::jointIndex(std::string_view name) const {
  return indexByName(joints, name, "joint");
}
int Skeleton::coordinateIndex(std::string_view name) const {
  return indexByName(coordinates, name, "coordinate");
}
int Skeleton::landmarkIndex(std::string_view name) const {
  return indexByName(landmarks, name, "landmark");
}

}  // namespace sinew
