#pragma once
#include <memory>

#include "core/muscle/hill.h"
#include "core/muscle/musculature.h"
#include "core/retarget/peaks/fiber_table_internal.h"

namespace sinew {

/// Fibre : tendon ratio times `factor`, longest length (1.6 l0 + 1.03 l_slack) kept.
void setFiberTendonRatio(MusculotendonUnit& unit, double factor);

/// What forces depend on: for copies that are made often.
MusculotendonUnit withoutPath(const MusculotendonUnit& unit);

/// The active force of a fully active unit as a function of a factor on its fibre : tendon ratio, many times over:
/// Newton on tabulated curves from the fibre length found last.
class RatioForce {
 public:
  /// `table`: of the unit's curves and pennation.
  RatioForce(const MusculotendonUnit& unit, std::shared_ptr<const FiberTable> table);
  explicit RatioForce(const MusculotendonUnit& unit);
  void setFactor(double factor);
  /// Force [N] along the tendon and its slope with the factor. `fiber`: normalised length; in, where to start (0:
  /// nothing known); out, where it is, and its slope with the factor.
  CurveValue at(double length_m, CurveValue& fiber) const;

 private:
  CurveValue beyondTable(double length_m, CurveValue& fiber) const;

  MusculotendonUnit original_;  ///< without its path
  HillCurves curves_;
  std::shared_ptr<const FiberTable> table_;
  double cosine_;                ///< of the pennation angle
  double by_fiber_, by_tendon_;  ///< what the longest length takes of 1 m of each
  // At the factor set last; slopes with it.
  double slack_m_ = 0, slack_slope_ = 0;               ///< of the tendon; slope: relative
  double fiber_ = 0, fiber_slope_ = 0, shortest_ = 0;  ///< along the tendon at optimal length, in slack lengths;
                                                       ///< whole unit where its fibre is shortest
};

}  // namespace sinew
