#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/muscle/musculature.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// What the units of a model do, judged by tables of published moment arms and of anatomical functions. A table may be
// anybody's; the left column is ours, the right one is understood as well:
//   coordinate         dof               with or without side; without, the muscle's
//   other_posture_deg  pose_other_dofs   "elbow_flexion_r=90;hip_flexion_r=45", all else 0
//   min_cm, max_cm     accept_min_cm, accept_max_cm
//   min_deg, max_deg   test_min_deg, test_max_deg
// A muscle without side is the right one.

struct MomentArmReference {
  std::string where;  ///< "moment_arms.csv: line 12"
  int unit = -1, coordinate = -1;
  std::map<std::string, double> posture_deg;        ///< the coordinate's own angle included
  double reference_cm = 0, min_cm = 0, max_cm = 0;  ///< positive = increases the coordinate
};

/// Columns muscle, coordinate, other_posture_deg, angle_deg, reference_cm, min_cm, max_cm.
/// @throws InputError naming file, line, field, expected, found; unknown names with the nearest.
std::vector<MomentArmReference> loadMomentArmReferences(const std::filesystem::path& file, const Skeleton& skeleton,
                                                        const Musculature& musculature);

struct MomentArmVerdict {
  double arm_cm = 0;
  bool inside = false;      ///< between min and max
  bool wrong_sign = false;  ///< where |reference| >= 1.5 cm
};

/// One verdict a reference. Smallest |reference| for which a wrong sign counts [cm].
inline constexpr double kSignMatters_cm = 1.5;
std::vector<MomentArmVerdict> judgeMomentArms(const Skeleton& skeleton, const Musculature& musculature,
                                              const std::vector<MomentArmReference>& references);

enum class FunctionStrength { Principal, Secondary, PostureDependent };

struct FunctionReference {
  std::string where;
  int unit = -1, coordinate = -1;
  double sign = 1;  ///< of the moment: +1 increases the coordinate
  FunctionStrength strength = FunctionStrength::Principal;
  double min_deg = 0, max_deg = 0;            ///< of the coordinate: where the function is tested
  std::map<std::string, double> posture_deg;  ///< the test posture; the coordinate is at 0 unless named
};

/// Columns muscle, coordinate, sign (+ or -), strength (principal, secondary, posture_dependent), min_deg, max_deg,
/// other_posture_deg (or test_pose). A function given twice, by the agonist's and the antagonist's row, counts once.
/// @throws InputError as above.
std::vector<FunctionReference> loadFunctionReferences(const std::filesystem::path& file, const Skeleton& skeleton,
                                                      const Musculature& musculature);

struct FunctionVerdict {
  double arm_cm = 0;          ///< in the test posture
  bool right = false;         ///< sign in the test posture
  double share_of_range = 0;  ///< of 41 angles from min to max: with the right sign
};
std::vector<FunctionVerdict> judgeFunctions(const Skeleton& skeleton, const Musculature& musculature,
                                            const std::vector<FunctionReference>& references);

}  // namespace sinew
