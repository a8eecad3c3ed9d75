#pragma once
#include <string>
#include <vector>

#include "core/skeleton/kinematics.h"

namespace sinew {

// Postures that a healthy adult can take, made from published norms: what muscle lengths are fitted to. Quasi-random
// and synthetic: the same options give the same postures everywhere. See docs/methods/muscle_model.md.

/// What one joint forbids another, where muscles span both: first + slope * second <= limit [degrees].
struct PoseCoupling {
  std::string first;  ///< coordinate without side; "-" before the name turns its sign
  double slope = 0;
  std::string second;
  double limit_deg = 0;
  std::string source;
};
/// Straight-leg raise, rectus femoris, gastrocnemius, gracilis and iliotibial tract of adults.
const std::vector<PoseCoupling>& normalPoseCouplings();

/// Right limbs and trunk move, left limbs rest (units span one side and the midline): single coordinates at their
/// normal limits, the ends of clinical tests, then `random_count` scrambled Halton points - every ball joint inside
/// the ellipsoid of its normal limits, every hinge inside its interval; what a coupling forbids is left out.
std::vector<Posture> normalPostures(const Skeleton& skeleton, int random_count = 6000, unsigned seed = 2026);

/// Postures in which nothing may pull: standing, neutral body posture without gravity, arms held sideways ("T").
std::vector<Posture> restingPostures(const Skeleton& skeleton);

}  // namespace sinew
