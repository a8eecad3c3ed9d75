#pragma once
#include <limits>
#include <vector>

#include "core/muscle/musculature.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// Can activations turn every coordinate both ways? At a posture the units load the clinical coordinates with
//   tau = R a,   R_kj = moment arm of unit j about coordinate k x the force that full activation adds to unit j,
// a >= 0, because a muscle only pulls. The body is controllable there if every direction +-e_k is met: then the
// columns of R span the space positively. The free root is left out: inner forces cannot move it, only outer ones
// can.

/// One coordinate turned one way at one posture.
struct DirectionOfControl {
  /// |R a - e| of the nearest a >= 0, e the unit torque: 0 = reached, 1 = nothing acts that way.
  double residual = 1;
  /// The largest torque about this coordinate alone, all others in balance, with 0 <= a <= 1 [N m, >= 0].
  double strength_Nm = std::numeric_limits<double>::quiet_NaN();
};

struct CoordinateControl {
  int coordinate = -1;
  DirectionOfControl increasing, decreasing;
};

/// 44 rows in the order of Skeleton::coordinates (all but the root's). Bounded least squares, two a direction: 0.3 s.
std::vector<CoordinateControl> controllability(const Skeleton& skeleton, const Musculature& musculature,
                                               const Posture& posture);

/// The residuals alone; strengths stay NaN.
std::vector<CoordinateControl> controllable(const Skeleton& skeleton, const Musculature& musculature,
                                            const Posture& posture);

}  // namespace sinew
