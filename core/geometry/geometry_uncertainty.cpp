#include "core/geometry/geometry_uncertainty.h"

namespace sinew {

Eigen::Matrix<double, kViewErrors, 1> standardDeviations(const GeometryUncertainty& u) {
  Eigen::Matrix<double, kViewErrors, 1> sd;
  sd << u.scale, u.image_shift_px, u.image_shift_px, u.body_distance_m, u.turn_rad, u.turn_rad, u.turn_rad, u.k1;
  return sd;
}

}  // namespace sinew
