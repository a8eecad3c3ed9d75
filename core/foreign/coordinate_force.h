#pragma once
#include <string>
#include <variant>

#include "core/passive/passive_moment.h"

namespace sinew {

/// OpenSim's CoordinateLimitForce in SI units (radians and N m, or metres and N): beyond a limit a spring whose
/// stiffness rises from 0 over `transition` along 10 x^3 - 15 x^4 + 6 x^5. Its damping is not kept: this is statics.
struct CoordinateLimit {
  double upper = 0, upper_stiffness = 0, lower = 0, lower_stiffness = 0, transition = 0;
  friend bool operator==(const CoordinateLimit&, const CoordinateLimit&) = default;
};

/// What a coordinate of another program sets against itself: capsule, ligaments, stops.
struct ForeignCoordinateForce {
  std::string name;
  int coordinate = -1;
  std::variant<PassiveMoment, CoordinateLimit> law;  ///< ours, as an expression in an .osim file; or OpenSim's own
};

/// Generalised force at a value of the coordinate [N m or N], positive = towards larger values.
double coordinateForce(const CoordinateLimit& limit, double q);
double coordinateForce(const ForeignCoordinateForce& force, double q);

}  // namespace sinew
