#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "core/job.h"
#include "core/retarget/prepared/range_samples.h"

namespace sinew {

/// What one joint's postures measure in a body, where a longest length could still decide about them.
struct RangeLengths {
  struct Length {
    double length_m;
    std::uint32_t posture;  ///< of `postures`
  };
  std::vector<std::uint32_t> postures;        ///< of the joint's samples
  std::vector<std::vector<Length>> of_units;  ///< in the order of the joint's units
};

/// Bounds of the longest length of every unit [m].
struct LongestLengths {
  std::vector<double> start_m;  ///< to begin from, and kept by every unit that it costs nothing to keep
  std::vector<double> least_m;  ///< at most that; nothing shorter is tried
};

struct RangeFit {
  Outcome outcome = Outcome::NotRun;
  std::vector<double> longest_m;                             ///< by unit
  std::vector<std::shared_ptr<const RangeLengths>> lengths;  ///< by joint of the samples: for the next fit
};

/// Longest lengths, within 7 % of where they begin, with which the muscles of a body allow the postures that those of
/// the reference allow, and no others: the weight of the wrong ones falls until no single unit can lower it further.
/// `known`: by joint, lengths() of an earlier fit where nothing has changed that they depend on, else null; may be
/// empty.
RangeFit fitToRanges(const RangeSamples& samples, const Model& body, const LongestLengths& bounds,
                     std::vector<std::shared_ptr<const RangeLengths>> known, const Job& job = {});

}  // namespace sinew
