#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/model/model.h"
#include "core/rom/tests/clinical_tests.h"

namespace sinew {

/// The movement of a test on one side of one body, as geometry: where every coordinate is after s degrees of it. A
/// moving coordinate halts at its own stop; beyond the end of the movement all go on from there, and before its start
/// they go back, which is where contractures are.
class Movement {
 public:
  struct Moved {
    int coordinate;
    double share;     ///< degrees a degree of the movement
    double stop_rad;  ///< where it halts
    double end_rad;   ///< where it is at the end of the movement
  };

  /// @throws InputError for coordinates that the skeleton does not have.
  Movement(const Skeleton& skeleton, const ClinicalTest& test, char side);

  double direction() const { return direction_; }  ///< +1 or -1: sign of s along the movement
  double from_deg() const { return from_deg_; }
  /// Where the last moving coordinate halts, or the test's own end.
  double end_deg() const { return end_deg_; }
  const std::vector<Moved>& moved() const { return moved_; }
  /// Whether it goes on between `s_deg` and a little further.
  bool moves(const Moved& m, double s_deg) const;
  double value_rad(const Moved& m, double s_deg) const;
  /// Clinical coordinates at s.
  Eigen::VectorXd clinical(double s_deg) const;
  /// The test's angle at s [deg].
  double angle_deg(double s_deg) const;
  /// Where the test's angle is `angle_deg`, looked for between two places.
  double placeOf_deg(double angle_deg, double low_deg, double high_deg) const;
  /// Coordinates that stand at their stop.
  std::vector<std::string> stopped(const Skeleton& skeleton, double s_deg) const;

 private:
  bool halted(const Moved& m, double s_deg) const;
  /// Where the joint of a moved coordinate leaves its edited range before the coordinate's own stop.
  double stopInEditedRange_rad(const Skeleton& skeleton, const Moved& m) const;

  double direction_, from_deg_, end_deg_ = 0;
  Eigen::VectorXd base_;
  std::vector<Moved> moved_;
  std::vector<std::pair<int, double>> reads_;  ///< coordinate, factor
  double read_offset_deg_ = 0;
};

}  // namespace sinew
