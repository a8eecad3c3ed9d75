#pragma once
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "core/muscle/hill_parameters.h"

namespace sinew {

/// A path point hangs on one or more segments (linear blend skinning): p_W = sum_j weight_j X_WBj p_Bj.
struct Anchor {
  int segment = -1;
  double weight = 1;
  Eigen::Vector3d p_B = Eigen::Vector3d::Zero();
};

enum class PathPointRole { Origin, Via, Insertion };

struct PathPoint {
  PathPointRole role = PathPointRole::Via;
  std::vector<Anchor> anchors;  ///< weights >= 0, sum 1
  std::string bone;             ///< bone that it lies on or guides it, e.g. "fibula"
  std::string site;             ///< anatomical site in words
};

/// One musculotendon unit: constant data. Names follow OpenSim's Muscle.
struct MusculotendonUnit {
  std::string name;   ///< "soleus_medial_r"
  std::string group;  ///< "triceps_surae"
  double max_isometric_force_N = 0;
  double optimal_fiber_length_m = 0;
  double tendon_slack_length_m = 0;
  double pennation_angle_at_optimal_rad = 0;
  HillParameters curves;        ///< Thelen's unless a person edited them
  std::vector<PathPoint> path;  ///< origin, via points, insertion
  std::string source;           ///< of the physiological figures
};

struct Musculature {
  std::vector<MusculotendonUnit> units;

  /// Index by name. @throws InputError with the nearest names if there is none.
  int unitIndex(std::string_view name) const;
  const MusculotendonUnit& unit(std::string_view name) const { return units[unitIndex(name)]; }
};

}  // namespace sinew
