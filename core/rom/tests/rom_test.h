#pragma once
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/model.h"

namespace sinew {

// Clinical range-of-motion tests with published norms, as data (rom/rom_norms.json), and their simulation on a model:
// what makes a body's ranges comparable with those of people. Angles in the signs of the skeleton's coordinates.

/// What people have: mean and SD of adults, or the range that gymnasts reach; NaN where nobody has said.
struct RomNorm {
  double mean_deg = std::numeric_limits<double>::quiet_NaN(), sd_deg = std::numeric_limits<double>::quiet_NaN();
  double accept_min_deg = std::numeric_limits<double>::quiet_NaN(),
         accept_max_deg = std::numeric_limits<double>::quiet_NaN();
  bool known() const { return accept_min_deg <= accept_max_deg; }
  /// Degrees outside the accepted range, 0 inside.
  double outside_deg(double angle_deg) const;
};

struct RomTest {
  std::string id;                                                ///< "popliteal_adult"
  std::string title;                                             ///< "popliteal angle, other hip straight"
  std::map<std::string, double> posture_deg, contralateral_deg;  ///< coordinates without side
  /// Coordinates that move together, degrees each per degree of the movement; each halts at its own stop.
  std::map<std::string, double> moves;
  std::map<std::string, double> reads;  ///< written angle = offset + sum of factor * coordinate; the moved ones, say
  double read_offset_deg = 0;
  double from_deg = 0, to_deg = 0;  ///< of the movement; to_deg where nobody goes
  double threshold_Nm = 0;          ///< passive moment about the movement at which the examiner stops
  std::map<std::string, RomNorm, std::less<>> norms;  ///< by preset
  std::string limited_by;                             ///< what is expected to hold
  std::string source, confidence;

  /// Posture that the test is done in, the moving coordinates at the start.
  Posture posture(const Skeleton& skeleton, char side) const;
  std::map<std::string, double> sidedPosture(const Skeleton& skeleton, char side) const;
};

/// What one joint does to another: the difference of two tests.
struct RomCoupling {
  std::string id, title;
  std::string first, second;  ///< tests; the difference is first - second of |angles| or of signed ones, see `sign`
  double sign = 1;            ///< the difference is sign * (first - second)
  bool must_be_positive = false;  ///< whatever the figures: the relation itself is anatomy
  std::map<std::string, RomNorm, std::less<>> norms;
  std::string source;
};

/// A row of the norms that the model cannot be asked, and why.
struct RomNotAsked {
  std::string id, reason;
};

struct RomNorms {
  std::vector<RomTest> tests;
  std::vector<RomCoupling> couplings;
  std::vector<RomNotAsked> not_asked;
  std::string thresholds;                          ///< what the thresholds rest on
  const RomTest& test(std::string_view id) const;  ///< @throws InputError with the nearest ids
};
/// @throws InputError: file, entry, expected, found; also for unknown coordinates and tests.
RomNorms loadRomNorms(const std::filesystem::path& resource_dir, const Skeleton& skeleton);

struct RomReading {
  std::string test;
  double angle_deg = std::numeric_limits<double>::quiet_NaN();  ///< as written down
  double moment_Nm = std::numeric_limits<double>::quiet_NaN();  ///< passive, against the movement, where it ended
  bool stopped_by_joint = false;
  std::vector<std::string> limited_by;  ///< units with the largest shares of the moment, or the joint's stop
};

/// Moves from `from_deg` until the passive moment of all units against the movement reaches the threshold, or every
/// moving coordinate is at its stop. Of a movement of several coordinates the moment is the work per degree of it.
RomReading simulateRomTest(const Model& model, const RomTest& test, char side = 'r');

}  // namespace sinew
