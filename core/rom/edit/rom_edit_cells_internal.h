#pragma once
#include <vector>

#include "core/kernel/compiled_model.h"
#include "core/rom/edit/rom_edit_solve.h"
#include "core/rom/edit/threshold_fit_internal.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

/// Everything about one joint that edits of it ask again and again: what every unit that spans it measures in every
/// cell of every held posture. A cell of a ball joint is that of its map, a cell of a hinge is one degree.
/// Sample = slice * cellCount() + cell.
class JointCells {
 public:
  /// Incomplete if cancelled.
  JointCells(const Model& model, int joint, const std::vector<HeldPosture>& held, const Job& job);

  int joint() const { return joint_; }
  bool isBall() const { return ball_; }
  const std::vector<HeldPosture>& held() const { return held_; }
  std::size_t cellCount() const { return cells_; }
  std::size_t sampleCount() const { return cells_ * held_.size(); }
  const std::vector<int>& units() const { return units_; }
  /// By unit, in the order of units(): path lengths [m], ascending.
  const std::vector<ThresholdColumn>& columns() const { return columns_; }

  /// The skeleton with these units alone.
  const CompiledModel& compiled() const { return compiled_; }

  double angle_rad(std::size_t cell) const;  ///< of a hinge

  /// Which samples these longest lengths let through; by unit of the model.
  std::vector<std::uint8_t> allowed(const std::vector<double>& longest_m) const;

 private:
  Posture posture(const Posture& held, std::size_t cell) const;
  void measure(const Job& job);

  int joint_, first_coordinate_;
  bool ball_;
  std::vector<HeldPosture> held_;
  std::size_t cells_ = 0;
  double first_angle_rad_ = 0;
  std::vector<Eigen::Vector3d> cell_vector_;  ///< rotation vector of every cell of a ball joint
  std::vector<int> units_;
  CompiledModel compiled_;
  std::vector<ThresholdColumn> columns_;
};

}  // namespace sinew
