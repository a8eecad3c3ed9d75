#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/skeleton/kinematics.h"

namespace sinew {

// How far a body of one flexibility reaches: data (rom/PRESET.json, sources in every entry) that pose sets are
// sampled from, and that joint stops are taken from. See docs/methods/range_of_motion.md.

inline constexpr std::string_view kDefaultPreset = "average-adult";
/// "average-adult", "athlete".
const std::vector<std::string>& romPresetNames();

/// One end of a coordinate's range, or what one joint forbids another (muscles that span both, or the rhythm of the
/// shoulder): sum of factor * coordinate <= end [degrees]. Coordinates are named without side.
struct RomBound {
  struct Term {
    std::string coordinate;
    double factor = 1;
  };
  std::string name;         ///< "hip_flexion max", "hip_flexion - 0.5 knee_flexion"
  std::vector<Term> terms;  ///< one, of factor 1 or -1: a plain end of range, which is also a stop of the joint
  double end_deg = 0;       ///< end that an examiner feels, as the sum
  std::string test;         ///< simulated test that must get as far as `target_deg` (core/rom/fit_preset.h); or empty
  double target_deg = 0;    ///< as the test is written down
  std::string source;

  bool isCoupling() const { return terms.size() > 1; }
};

/// A test that is no end of a single range, but must get as far all the same: the arm overhead with its girdle, say.
struct RomTarget {
  std::string test;
  double target_deg = 0;  ///< as written down
  bool to_stops = false;  ///< instead of a target: until every moving coordinate is at its stop
};

struct RomPreset {
  std::string name, title, note;
  std::vector<RomBound> bounds;
  std::vector<RomTarget> more_targets;
  /// Those of the bounds, then the others.
  std::vector<RomTarget> targets() const;
};

/// Reads rom/PRESET.json. @throws InputError with the nearest names, or naming file, entry,
/// expected, found; also if a coordinate of `skeleton` has no range.
RomPreset loadRomPreset(const std::filesystem::path& resource_dir, std::string_view name, const Skeleton& skeleton);

/// A bound of one side, by coordinate index: sum of factor * q <= limit_rad.
struct SidedBound {
  std::vector<std::pair<int, double>> terms;
  double limit_rad = 0;
  double excess_rad(const Eigen::VectorXd& clinical) const {
    double sum = -limit_rad;
    for (const auto& [coordinate, factor] : terms) sum += factor * clinical[coordinate];
    return sum;
  }
};
SidedBound sidedBound(const Skeleton& skeleton, const RomBound& bound, char side);
/// Both sides of every bound.
std::vector<SidedBound> sidedBounds(const Skeleton& skeleton, const RomPreset& preset);

/// Index of a coordinate named without side: "hip_flexion" and 'r', or a midline one.
int sidedCoordinate(const Skeleton& skeleton, const std::string& name, char side);

/// Takes the joint stops from the preset's plain bounds.
void setStops(Skeleton& skeleton, const RomPreset& preset);

}  // namespace sinew
