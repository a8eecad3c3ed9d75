#pragma once
#include <vector>

#include "core/job.h"
#include "core/model/model.h"
#include "core/rom/pose_set.h"

namespace sinew {

// Step 2 of retargeting (Ryu et al., Muscle Length Estimation): the longest length of a muscle in its new body is to
// its longest path over the pose set what it was in the reference. So whatever made it longer there - key postures,
// clinical tests, an examination - lengthens it here by the same share, and every posture of the set stays valid.

/// Longest path of every unit over a pose set [m]. Two threads and more; empty if the job was cancelled.
std::vector<double> longestOverPoses(const Skeleton& skeleton, const Musculature& musculature, const PoseSet& poses,
                                     const Job& job = {});

struct MaximalLengths {
  Outcome outcome = Outcome::NotRun;
  std::vector<double> longest_path_m;  ///< by unit, in the new body
  std::vector<double> factor;          ///< by unit: new fibre and tendon length relative to the reference's
  int relaxed = 0;                     ///< units lengthened further, because they would have pulled at rest
};

/// Fibre and tendon of every unit of `model`, in the reference's ratio. `reference_longest_m`:
/// longestOverPoses() of the reference. Units that would pull at rest (core/rom/length_estimation.h) though the
/// reference's do not are lengthened until they pull no more than there. A cancelled job leaves `model` as it was.
/// `known_longest_m`: longest paths found before [m], 0 where unknown; empty: nothing is.
MaximalLengths setMaximalLengths(const Model& reference, const std::vector<double>& reference_longest_m,
                                 const PoseSet& poses, Model& model, const Job& job = {},
                                 const std::vector<double>& known_longest_m = {});

}  // namespace sinew
