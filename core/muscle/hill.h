#pragma once
#include "core/muscle/hill_parameters.h"

namespace sinew {

// Hill-type muscle of Thelen 2003 (J Biomech Eng 125:70-77), quasi-static, constant pennation:
//   F = F_max (a f_CE(l) + f_PE(l)) cos(pennation) = F_max f_SE(l_t / l_slack),   l = fibre length / optimal length.
// Every curve is C1 and comes with its derivative: where the published one has a corner (onset of passive and tendon
// force, isometric point and both ends of force-velocity) a cubic over the next few per cent of its range rounds it
// off; elsewhere the values are the published ones. See docs/methods/muscle_model.md.

struct CurveValue {
  double value = 0;
  double slope = 0;
};

/// The curves of one unit: HillParameters, with what every evaluation needs computed once. The free functions below
/// are those of the published parameters.
class HillCurves {
 public:
  explicit HillCurves(const HillParameters& parameters);
  CurveValue active(double normalized_fiber_length) const;
  CurveValue passive(double normalized_fiber_length) const;
  CurveValue tendon(double normalized_tendon_length) const;
  CurveValue velocity(double normalized_fiber_velocity, double activation) const;

 private:
  HillParameters p_;
  double passive_scale_;
};

/// Active force-length: Gaussian exp(-(l - 1)^2 / 0.45).
CurveValue activeForceLength(double normalized_fiber_length);
/// Passive force-length: exponential, 0 for l <= 1, 1 at l = 1.6 (strain 0.6; shape 5).
CurveValue passiveForceLength(double normalized_fiber_length);
/// Tendon force-strain: exponential toe then linear; 0 for l_t <= l_slack, 1 at strain 0.033.
CurveValue tendonForceLength(double normalized_tendon_length);
/// Force-velocity factor, velocity in optimal fibre lengths per second, lengthening positive; v_max = 10 / s.
/// 0 at and beyond the fastest shortening, 1 isometric, towards 1.4 in lengthening.
CurveValue forceVelocity(double normalized_fiber_velocity, double activation = 1);

struct MusculotendonUnit;

/// Shortest fibre, in optimal lengths, that still turns tension into force; a fibre never gets shorter in the model.
inline constexpr double kShortestFiber = 0.2;

/// Static equilibrium of fibre and tendon.
struct FiberState {
  double fiber_length_m = 0;
  double tendon_length_m = 0;
  double normalized_fiber_length = 0;
  double force_N = 0;         ///< along the tendon
  double active_force_N = 0;  ///< share of the active element
  bool slack = false;         ///< the path is too short to be pulled tight: no force
};

/// Equilibrium at a path length and an activation in [0, 1]. Never lets a fibre length <= 0 into the curves: the
/// fibre stops at kShortestFiber; what the path is shorter then is slack tendon. The force is continuous in both
/// arguments.
FiberState equilibrium(const MusculotendonUnit& unit, double musculotendon_length_m, double activation);

/// Longest length that the unit allows, k_m l0 + k_t l_slack with k_m = 1.6, k_t = 1.03 (Ryu et al., Muscle-induced
/// range of motion): its fibre is at the strain where passive force reaches F_max. With edited curves k_m is 1 + the
/// passive strain, and k_t keeps its share 0.03 / 0.033 of the tendon strain.
double longestLength_m(const MusculotendonUnit& unit);

}  // namespace sinew
