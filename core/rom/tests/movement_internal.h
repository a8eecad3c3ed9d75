#pragma once
#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "core/rom/tests/rom_test.h"

namespace sinew {

/// A test on one side of one model: postures along the movement, and what the units do about it. The model's lengths
/// may change between calls; its paths and stops may not.
class Movement {
 public:
  Movement(const Model& model, const RomTest& test, char side);

  double direction() const { return direction_; }
  /// Where the last moving coordinate halts.
  double end_deg() const { return end_deg_; }
  /// Clinical coordinates at s; each moving one halts at its stop.
  Eigen::VectorXd clinical(double s_deg) const;
  /// Moments against the movement by unit, largest first [N m].
  std::vector<std::pair<double, int>> moments(double s_deg) const;
  double resistance_Nm(double s_deg) const;
  /// First unit that is beyond its longest length; -1 if none is.
  int overstretched(double s_deg) const;
  /// Path of a unit [m].
  double length_m(int unit, double s_deg) const;
  /// Coordinates that stand at their stop.
  std::vector<std::string> stopped(double s_deg) const;

 private:
  struct Moved {
    int coordinate;
    double share, stop_rad;
  };
  /// Where the joint of a moved coordinate leaves its edited range before the coordinate's own stop.
  double stopInEditedRange_rad(const Moved& m, double from_deg) const;
  bool halted(const Moved& m, double s_deg) const;
  double at(const Moved& m, double s_deg) const;
  std::vector<RigidTransform> poses(double s_deg, double ds_deg) const;
  void keepThoseThatStretch(double from_deg);

  const Model& model_;
  double direction_;
  Eigen::VectorXd base_;
  std::vector<Moved> moved_;
  double end_deg_ = 0;
  std::vector<int> units_;
};

}  // namespace sinew
