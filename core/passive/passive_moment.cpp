#include "core/passive/passive_moment.h"

#include <cmath>
#include <limits>

#include "core/error.h"

namespace sinew {
namespace {

/// exp(x), straight on from kLargestPassiveExponent; its derivative and its integral from minus infinity.
struct BoundedExponential {
  double value, slope, integral;
};

BoundedExponential boundedExponential(double x) {
  if (x <= kLargestPassiveExponent) {
    const double e = std::exp(x);
    return {e, e, e};
  }
  const double e = std::exp(kLargestPassiveExponent), beyond = x - kLargestPassiveExponent;
  return {e * (1 + beyond), e, e * (1 + beyond + 0.5 * beyond * beyond)};
}

BoundedExponential upper(const PassiveMoment& s, double q_rad) {
  return boundedExponential(s.upper_rate_per_rad * (q_rad - s.upper_rad));
}

BoundedExponential lower(const PassiveMoment& s, double q_rad) {
  return boundedExponential(s.lower_rate_per_rad * (s.lower_rad - q_rad));
}

/// Angle beyond the anchor at which a moment of `anchor_Nm` there has become `moment_Nm`.
double beyondAnchor_rad(double anchor_Nm, double rate_per_rad, double moment_Nm) {
  require(moment_Nm > 0, "passive structures: the moment that an angle is asked for is positive");
  if (anchor_Nm <= 0) return std::numeric_limits<double>::infinity();
  const double exponent = std::log(moment_Nm / anchor_Nm);
  if (exponent <= kLargestPassiveExponent) return exponent / rate_per_rad;
  const double straight = moment_Nm / (anchor_Nm * std::exp(kLargestPassiveExponent)) - 1;
  return (kLargestPassiveExponent + straight) / rate_per_rad;
}

}  // namespace

double passiveMoment_Nm(const PassiveMoment& s, double q_rad) {
  return s.lower_Nm * lower(s, q_rad).value - s.upper_Nm * upper(s, q_rad).value;
}

double passiveStiffness_Nm_rad(const PassiveMoment& s, double q_rad) {
  return s.lower_Nm * s.lower_rate_per_rad * lower(s, q_rad).slope +
         s.upper_Nm * s.upper_rate_per_rad * upper(s, q_rad).slope;
}

double passiveEnergy_J(const PassiveMoment& s, double q_rad) {
  return s.lower_Nm / s.lower_rate_per_rad * lower(s, q_rad).integral +
         s.upper_Nm / s.upper_rate_per_rad * upper(s, q_rad).integral;
}

double upperAngleAt_rad(const PassiveMoment& s, double moment_Nm) {
  return s.upper_rad + beyondAnchor_rad(s.upper_Nm, s.upper_rate_per_rad, moment_Nm);
}

double lowerAngleAt_rad(const PassiveMoment& s, double moment_Nm) {
  return s.lower_rad - beyondAnchor_rad(s.lower_Nm, s.lower_rate_per_rad, moment_Nm);
}

}  // namespace sinew
