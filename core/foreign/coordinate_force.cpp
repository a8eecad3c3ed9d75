#include "core/foreign/coordinate_force.h"

#include <algorithm>

namespace sinew {
namespace {

/// 0 before 0, 1 after 1, second derivative continuous.
double smoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 + x * (-15 + 6 * x));
}

/// Share of the stiffness `beyond` a limit.
double engaged(double beyond, double transition) {
  if (beyond <= 0) return 0;
  return transition > 0 ? smoothStep(beyond / transition) : 1;
}

}  // namespace

double coordinateForce(const CoordinateLimit& limit, double q) {
  const double above = q - limit.upper, below = limit.lower - q;
  return limit.lower_stiffness * engaged(below, limit.transition) * below -
         limit.upper_stiffness * engaged(above, limit.transition) * above;
}

double coordinateForce(const ForeignCoordinateForce& force, double q) {
  if (const auto* limit = std::get_if<CoordinateLimit>(&force.law)) return coordinateForce(*limit, q);
  return passiveMoment_Nm(std::get<PassiveMoment>(force.law), q);
}

}  // namespace sinew
