#pragma once
#include <array>
#include <span>

namespace sinew {

// What Ryu et al. characterise a length-angle curve by (Muscle Routing Optimization): where it is longest, where it
// is shortest, and by how much these differ. Extrema lie on the parabola through the extreme sample and its
// neighbours, so that all three figures move smoothly with the samples.

/// An extremum of evenly sampled values and how it moves with the three samples around it.
struct CurveExtremum {
  double theta = 0;  ///< in [0, 1]
  double value = 0;
  int first_sample = 0;                        ///< of the three
  std::array<double, 3> theta_slope{};         ///< dtheta / dsample; 0 where the extremum is held by an end
  std::array<double, 3> value_slope{1, 0, 0};  ///< dvalue / dsample
};

struct CurveFeatures {
  CurveExtremum longest, shortest;
  double range() const { return longest.value - shortest.value; }
};

/// @param samples at least 3, evenly spaced in theta from 0 to 1.
CurveFeatures curveFeatures(std::span<const double> samples);

}  // namespace sinew
