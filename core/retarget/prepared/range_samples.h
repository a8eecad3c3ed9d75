#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/kernel/pose_table.h"
#include "core/model/model.h"

namespace sinew {

/// Postures of one joint at the edge of what the reference's muscles allow.
struct JointRangeSamples {
  struct Sample {
    Eigen::Vector3f own;   ///< the joint's own entries; of a hinge the first
    std::uint16_t others;  ///< what all other joints do, by number
    bool valid;            ///< no unit that spans the joint is beyond its longest length
    float weight;          ///< share of the joint's valid postures that it stands for, in thousandths
  };
  int joint = -1, first_coordinate = 0, coordinate_count = 0;
  std::vector<int> units;  ///< that span it
  std::vector<Sample> samples;
};

/// What the longest lengths of a new body are fitted to: which postures the muscles of the reference allow and which
/// they do not; every joint on its own, over all its orientations, the others at zero or anywhere in their normal
/// ranges. Evenly drawn, the left side the mirror image of the right one; what lies near some unit's longest length
/// is kept. Made once for a reference.
class RangeSamples {
 public:
  explicit RangeSamples(const Model& reference);

  const std::vector<JointRangeSamples>& joints() const { return joints_; }
  /// Path lengths in `body` of the units that span a joint, by posture (numbers `first` to `first + count - 1`) and
  /// unit, chunk after chunk. The reference is judged and every body measured in this one way, in single precision:
  /// what nothing has changed about gives the same lengths.
  using Measured = std::function<void(std::size_t first, std::size_t count, const PoseTable& lengths_m)>;
  void measure(const JointRangeSamples& joint, const Model& body, const Measured& measured) const;

 private:
  void read(const JointRangeSamples& joint, std::size_t first, PoseTable& table) const;

  std::vector<Posture> others_;  ///< zero, then pairs of mirror images
  std::vector<JointRangeSamples> joints_;
};

}  // namespace sinew
