#pragma once
#include <vector>

namespace sinew {

// Capsule and ligaments of a joint: the moment that they set against a clinical coordinate near both ends of its
// range, in the exponential form of Anderson (1999, A dynamic optimization solution for a complete cycle of normal
// gait, PhD thesis, University of Texas at Austin):
//   tau(q) = - upper_Nm exp(upper_rate (q - upper_rad)) + lower_Nm exp(lower_rate (lower_rad - q))
// Figures and their sources: resources/skeleton/passive_moments.json; docs/methods/passive_structures.md.

/// Both ends of one coordinate. An end of moment 0 has no structures; the default has none at all.
struct PassiveMoment {
  double upper_Nm = 0;            ///< >= 0: size of the moment at `upper_rad`, back towards smaller values
  double upper_rate_per_rad = 1;  ///< > 0: it grows e-fold over 1 / rate
  double upper_rad = 0;
  double lower_Nm = 0;  ///< >= 0: size of the moment at `lower_rad`, back towards larger values
  double lower_rate_per_rad = 1;
  double lower_rad = 0;
  friend bool operator==(const PassiveMoment&, const PassiveMoment&) = default;
};

/// By coordinate index; the free root's entries are default ones. Empty: a model without passive structures. About a
/// ball joint the moments act on its clinical angles: they are the generalised forces that belong to the angles'
/// rates, minus the gradient of the energies' sum, so that no closed path through postures does work.
using PassiveMoments = std::vector<PassiveMoment>;

/// Beyond this exponent the curves go on straight along their tangent: far outside of the range every value is finite
/// and the moment still grows.
inline constexpr double kLargestPassiveExponent = 10;

/// tau(q), positive = towards larger coordinate values.
double passiveMoment_Nm(const PassiveMoment& structures, double q_rad);
/// -dtau/dq, >= 0.
double passiveStiffness_Nm_rad(const PassiveMoment& structures, double q_rad);
/// U(q), >= 0, with tau = -dU/dq; 0 in the limit far from the end for each of the two terms.
double passiveEnergy_J(const PassiveMoment& structures, double q_rad);

/// Where the structures of one end alone reach a moment [rad]; infinite (towards that end) if there are none.
/// @pre moment_Nm > 0.
double upperAngleAt_rad(const PassiveMoment& structures, double moment_Nm);
double lowerAngleAt_rad(const PassiveMoment& structures, double moment_Nm);

}  // namespace sinew
