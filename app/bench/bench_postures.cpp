#include "app/bench/bench_postures.h"

#include <random>

#include "core/skeleton/clinical_angles.h"

namespace sinew {

std::vector<Posture> benchPostures(const Skeleton& skeleton, std::size_t count) {
  std::mt19937_64 random{2026};
  std::vector<Posture> postures;
  postures.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::VectorXd clinical(skeleton.coordinateCount());
    for (Eigen::Index k = 0; k < clinical.size(); ++k) {
      const Coordinate& c = skeleton.coordinates[static_cast<std::size_t>(k)];
      const double t = static_cast<double>(random() >> 11) * 0x1p-53;  // [0, 1), alike with every library
      clinical[k] = c.translational ? t - 0.5 : c.athlete_min_rad + t * (c.athlete_max_rad - c.athlete_min_rad);
    }
    postures.push_back(postureFromClinical(skeleton, clinical));
  }
  return postures;
}

}  // namespace sinew
