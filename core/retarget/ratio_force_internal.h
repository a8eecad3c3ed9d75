#pragma once
#include "core/muscle/hill.h"
#include "core/muscle/musculature.h"

namespace sinew {

/// Fibre : tendon ratio times `factor`, longest length (1.6 l0 + 1.03 l_slack) kept.
void setFiberTendonRatio(MusculotendonUnit& unit, double factor);

/// What forces depend on: for copies that are made often.
MusculotendonUnit withoutPath(const MusculotendonUnit& unit);

/// The active force of a fully active unit as a function of a factor on its fibre : tendon ratio, many times over:
/// Newton from the fibre length found last.
class RatioForce {
 public:
  explicit RatioForce(const MusculotendonUnit& unit);
  void setFactor(double factor);
  /// Force [N] along the tendon and its slope with the factor. `normalized_fiber_length`: in, where to start (0:
  /// nothing known); out, where it is.
  CurveValue at(double length_m, double& normalized_fiber_length) const;

 private:
  MusculotendonUnit original_, unit_;  ///< without their paths
  HillCurves curves_;
  double cosine_;                                 ///< of the pennation angle
  double fiber_slope_m_ = 0, slack_slope_m_ = 0;  ///< with the factor
};

}  // namespace sinew
