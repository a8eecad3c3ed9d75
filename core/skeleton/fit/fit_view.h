#pragma once
#include <span>
#include <vector>

#include "core/geometry/geometry_uncertainty.h"

namespace sinew {

/// One radiograph, as the fit sees it.
struct FitView {
  View view;
  int exposure = 0;  ///< views of one exposure were taken at one instant; between two the patient may have moved
  GeometryUncertainty uncertainty;
};

/// Views that are exact and were taken at one instant.
inline std::vector<FitView> exactViews(std::span<const View> views) {
  std::vector<FitView> list;
  for (const View& view : views) list.push_back({view, 0, {}});
  return list;
}

/// How much a patient who is asked to stand still moves between two exposures: standard deviations about each axis.
struct MovementPrior {
  double turn_rad = 0.05235987755982988;        ///< 3 deg, of the whole body
  double shift_m = 0.010;                       ///< of the whole body
  double joint_rad = 0.017453292519943295;      ///< 1 deg, of hips, knees and ankles
  double bent_joint_rad = 0.08726646259971647;  ///< 5 deg, once the images say that a joint has moved
};

}  // namespace sinew
