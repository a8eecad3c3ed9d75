#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/muscle/musculature.h"

namespace sinew {

/// Centre line and radius of a drawn muscle.
struct MuscleSpindle {
  std::vector<Eigen::Vector3d> points;  ///< same frame as the path
  std::vector<double> radius_m;
};

/// A belly between two tendons along `path` [m]: as long as the fibres ask for, as thick as the physiological cross
/// section F_max / (60 N/cm^2) of a straight spindle, halved so that neighbours stay apart. A picture, not a measure.
/// Keeps every corner of the path.
MuscleSpindle muscleSpindle(const MusculotendonUnit& unit, const std::vector<Eigen::Vector3d>& path);

}  // namespace sinew
