#pragma once
#include <algorithm>
#include <numbers>
#include <random>
#include <string>

#include "core/skeleton/clinical_angles.h"

namespace sinew::test {

/// Clinical coordinates drawn evenly inside the athlete envelope, away from gimbal lock; the root stays near zero.
inline Eigen::VectorXd randomClinical(const Skeleton& skeleton, std::mt19937_64& random) {
  constexpr double kRadPerDeg = std::numbers::pi / 180;
  Eigen::VectorXd x(skeleton.coordinateCount());
  for (int i = 0; i < x.size(); ++i) {
    const Coordinate& c = skeleton.coordinates[i];
    const double t = std::generate_canonical<double, 53>(random);
    const double low = std::max(c.athlete_min_rad, -80 * kRadPerDeg);
    const double high = std::min(c.athlete_max_rad, 150 * kRadPerDeg);
    x[i] = c.translational ? t - 0.5 : low + t * (high - low);
  }
  return x;
}

/// The same posture seen in the mirror: sides change places, what goes to the right goes to the left.
inline Eigen::VectorXd mirroredClinical(const Skeleton& skeleton, const Eigen::VectorXd& clinical) {
  Eigen::VectorXd m = clinical;
  for (int i = 0; i < m.size(); ++i) {
    std::string name = skeleton.coordinates[i].name;
    if (name.ends_with("_r") || name.ends_with("_l")) {
      name.back() = name.back() == 'r' ? 'l' : 'r';
      m[skeleton.coordinateIndex(name)] = clinical[i];
    } else if (name == "pelvis_tz" || name.ends_with("list") || name.ends_with("rotation") ||
               name.ends_with("lateral_flexion")) {
      m[i] = -clinical[i];
    }
  }
  return m;
}

}  // namespace sinew::test
