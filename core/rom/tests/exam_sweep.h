#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/rom/tests/exam_test.h"

namespace sinew {

/// One test on one side of one model, prepared: path lengths and moment arms of every unit that the movement
/// stretches are tabulated over the sweep once, so that the same test can be asked again for other muscle lengths (a
/// solver does).
class ExamSweep {
 public:
  /// @throws InputError if the test names unknown coordinates.
  ExamSweep(const Model& model, const ExamTest& test, char side);

  /// Net passive moment against the movement at a coordinate value [rad]. `length_factors` by unit index; absent = 1.
  double resistance_Nm(double coordinate_rad, const std::map<int, double>& length_factors) const;

  /// Coordinate value where the resistance first reaches the threshold, not limited by the joint's stop [rad]. The
  /// muscles' curves go on beyond the stop, which gives a solver its slope there. Ends of the table if never reached.
  double freeAngle_rad(double threshold_Nm, const std::map<int, double>& length_factors) const;

  /// The joint's stop in the direction of the movement [rad].
  double stop_rad() const { return stop_rad_; }
  /// +1 or -1: sign of the movement in the coordinate.
  double direction() const { return direction_; }
  double start_rad() const { return start_rad_; }
  /// Value as written down, by the test's convention.
  double written_deg(double coordinate_rad) const;

  /// freeAngle limited by the stop, and who holds.
  SimulatedTest simulate(double threshold_Nm, const std::map<int, double>& length_factors = {}) const;

 private:
  struct SweptUnit {
    int unit;
    std::vector<double> length_m, moment_arm_m;  ///< by sample
  };
  /// Moment of one unit against the movement.
  double resistanceOf(const SweptUnit& swept, double coordinate_rad, double length_factor) const;

  const Model* model_;
  const ExamTest* test_;
  double start_rad_ = 0, stop_rad_ = 0, direction_ = 1;
  double table_begin_rad_ = 0, table_step_rad_ = 0;
  std::vector<SweptUnit> units_;
};

}  // namespace sinew
