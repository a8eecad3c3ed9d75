#pragma once
#include <memory>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"
#include "core/retarget/lengths/range_fit.h"

namespace sinew {

class RetargetReference;

// Step 2 of retargeting (Ryu et al., Muscle Length Estimation). The longest length of a muscle in its new body is to
// its longest path over the pose set what it was in the reference: whatever made it longer there - key postures,
// clinical tests, an examination - lengthens it here by the same share. From there all longest lengths are fitted to
// the ranges of motion of the reference (range_fit.h), none below its longest path: every posture of the set stays
// valid.

struct MaximalLengths {
  Outcome outcome = Outcome::NotRun;
  std::vector<double> longest_path_m;  ///< by unit, in the new body
  std::vector<double> factor;          ///< by unit: new fibre and tendon length relative to the reference's
  int relaxed = 0;                     ///< units lengthened further, because they would have pulled at rest
  std::vector<std::shared_ptr<const RangeLengths>> range_lengths;  ///< by joint of RangeSamples
};

/// An earlier result of the same reference, of which units may be taken over.
struct PreviousLengths {
  const MaximalLengths& lengths;
  const std::vector<bool>& unchanged;  ///< by unit: its path is the same in every posture, to the last bit
};

/// Fibre and tendon of every unit of `model`, in the reference's ratio. Units that would pull at rest
/// (core/rom/length_estimation.h) though the reference's do not are lengthened until they pull no more than there. A
/// cancelled job leaves `model` as it was. `previous` changes nothing about the result.
MaximalLengths setMaximalLengths(const RetargetReference& reference, Model& model, const Job& job = {},
                                 const PreviousLengths* previous = nullptr);

}  // namespace sinew
