#include "core/retarget/prepared/length_curve.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace sinew {
namespace {

/// Vertex of the parabola through the extreme sample and its neighbours. At an end of the curve the parabola through
/// the last three samples is followed up to the end: the extremum does not jump when it leaves the curve.
CurveExtremum extremumAt(std::span<const double> samples, int extreme) {
  const int last = static_cast<int>(samples.size()) - 1;
  const int middle = std::clamp(extreme, 1, last - 1);
  const double before = samples[static_cast<std::size_t>(middle - 1)], at = samples[static_cast<std::size_t>(middle)],
               after = samples[static_cast<std::size_t>(middle + 1)];
  const double bend = before - 2 * at + after;
  CurveExtremum e;
  e.first_sample = middle - 1;
  double t = extreme - middle;  // place relative to the middle sample, in samples
  if (std::abs(bend) > 1e-12) {
    const double vertex = 0.5 * (before - after) / bend;
    // Beyond an end, or the other kind of extremum (an end sample of a straight or hollow curve): the end itself.
    const bool inside = std::abs(vertex) < 1 && std::abs(vertex - t) <= 0.5 + 1e-12;
    if (inside) {
      t = vertex;
      const double lean = 0.5 * (before - after) / (bend * bend);
      e.theta_slope = {(0.5 / bend - lean) / last, 2 * lean / last, (-0.5 / bend - lean) / last};
    }
  }
  e.theta = (middle + t) / last;
  e.value_slope = {0.5 * t * (t - 1), 1 - t * t, 0.5 * t * (t + 1)};
  e.value = e.value_slope[0] * before + e.value_slope[1] * at + e.value_slope[2] * after;
  return e;
}

}  // namespace

CurveFeatures curveFeatures(std::span<const double> samples) {
  require(samples.size() >= 3, "curveFeatures: at least three samples");
  const auto [shortest, longest] = std::ranges::minmax_element(samples);
  return {extremumAt(samples, static_cast<int>(longest - samples.begin())),
          extremumAt(samples, static_cast<int>(shortest - samples.begin()))};
}

}  // namespace sinew
