#pragma once
#include <span>

#include "core/kernel/compiled_model.h"
#include "core/kernel/pose_table.h"
#include "core/kernel/precision.h"

namespace sinew {

// The kinematics, lengths and length gradients of many postures at once, or of one quickly. Postures are what they
// are everywhere else: one entry a coordinate, translations [m], rotation vectors and angles [rad] of any size.
// Results agree with segmentPoses(), pathLength() and lengthGradient() to 1e-12. Tables of the wrong size are made
// anew.

/// X_WB of every segment: entry 12 * segment + 4 * row + column of its upper three rows [R p].
void batchPoses(const CompiledModel& model, const PoseTable& postures, PoseTable& X_WB);

/// Path lengths [m], one entry a unit. In single precision equal models give equal lengths, but the last digits are
/// those of the instruction set.
void batchLengths(const CompiledModel& model, const PoseTable& postures, PoseTable& lengths_m,
                  Precision precision = Precision::Double);

/// Path lengths and dl/dq [m/rad] in the model's pattern: one entry each of gradientCoordinate().
void batchGradients(const CompiledModel& model, const PoseTable& postures, PoseTable& lengths_m,
                    PoseTable& gradients);

/// The same for one posture at a time: lengths by unit, gradients by entry of the pattern. Keeps its working memory,
/// so it belongs to one thread.
class PostureKernel {
 public:
  explicit PostureKernel(CompiledModel model);
  void evaluate(const Posture& posture);
  std::span<const double> lengths_m() const { return lengths_m_; }
  std::span<const double> gradients() const { return gradients_; }

 private:
  CompiledModel model_;
  LaneVector scratch_;
  std::vector<double> lengths_m_, gradients_;
};

}  // namespace sinew
