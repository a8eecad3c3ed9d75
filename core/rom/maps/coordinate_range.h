#pragma once
#include <limits>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"

namespace sinew {

/// How far one clinical coordinate can go while all others are held: to where the first of the units that it
/// stretches reaches its longest length, to where the passive moment - muscles, capsule and ligaments - against the
/// movement reaches the examiner's, if one is asked for, or to the joint's envelope.
struct CoordinateRange {
  int coordinate = -1;
  double low_rad = std::numeric_limits<double>::quiet_NaN();  ///< NaN if no value inside the envelope is free
  double high_rad = std::numeric_limits<double>::quiet_NaN();
  int low_unit = -1;   ///< the unit that is at its longest length there; -1: the joint's envelope comes first
  int high_unit = -1;  ///< likewise. Without a free value: the unit that is stretched beyond at the present one
  /// The examiner's moment ends it: the unit is the one with the largest share; -1: capsule and ligaments have it.
  bool low_by_moment = false, high_by_moment = false;
  bool isEmpty() const { return !(low_rad <= high_rad); }
};

/// The free interval that holds the present value, or the one nearest to it. Sampled every 3 degrees over the
/// envelope of this body, ends found by bisection to 0.01 degrees; a gap narrower than the samples can be missed.
/// @param clinical the posture as clinicalFromPosture() gives it; `coordinate` is an angle, not a translation.
/// @param examiner_Nm moment at which the examiner stops (core/rom/tests/threshold.h); infinite: nobody examines.
CoordinateRange muscleInducedRange(const Model& model, const Eigen::VectorXd& clinical, int coordinate,
                                   double examiner_Nm = std::numeric_limits<double>::infinity());

/// The same for every angle below the root, in the order of the coordinates; empty if cancelled.
/// @param examiner_Nm by coordinate, as examinerMoments_Nm() gives them; empty: nobody examines.
std::vector<CoordinateRange> muscleInducedRanges(const Model& model, const Eigen::VectorXd& clinical,
                                                 const Job& job = {}, const std::vector<double>& examiner_Nm = {});

}  // namespace sinew
