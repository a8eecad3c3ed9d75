#pragma once
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/skeleton/kinematics.h"

namespace sinew {

// One clinical test as data (resources/clinical/clinical_tests.json): what the simulated test, the form of the
// examination, the norms, the explorer, the lengths of a preset and the report are views of. Angles in degrees in the
// signs of the skeleton's coordinates; what a clinic writes is FormRow's to say.

/// What people have: mean and SD, or the range that gymnasts reach; NaN where nobody has said.
struct TestNorm {
  double mean_deg = std::numeric_limits<double>::quiet_NaN(), sd_deg = std::numeric_limits<double>::quiet_NaN();
  double accept_min_deg = std::numeric_limits<double>::quiet_NaN(),
         accept_max_deg = std::numeric_limits<double>::quiet_NaN();
  std::string source;
  bool verified = false;  ///< read in the source itself
  bool known() const { return accept_min_deg <= accept_max_deg; }
  /// Degrees outside the accepted range, 0 inside.
  double outside_deg(double angle_deg) const;
};

/// A norm of one age, perhaps of one sex.
struct AgeNorm {
  double from_y = 0, to_y = 200;  ///< from_y <= age < to_y
  std::string sex;                ///< "F", "M"; empty: both
  TestNorm norm;
};

/// How a test stands on the form of the examination.
struct FormRow {
  std::string protocol;                         ///< what the examiner does
  double scale = 1, offset_deg = 0;             ///< written = scale * angle + offset
  std::string convention;                       ///< "0 = straight, positive = lack of extension"
  double entry_min_deg = 0, entry_max_deg = 0;  ///< as written; outside: refused
  double doubt_min_deg = 0, doubt_max_deg = 0;  ///< outside: warning
  double measurement_sd_deg = 5;                ///< one standard deviation of one examiner
  std::string measurement_sd_source;
  /// Length groups that the test may change, the one that it is a test of first. Empty: it is only compared.
  std::vector<std::string> groups;

  double written_deg(double angle_deg) const { return scale * angle_deg + offset_deg; }
  double angle_deg(double written_deg) const { return (written_deg - offset_deg) / scale; }
};

struct ClinicalTest {
  std::string id;                                                ///< "popliteal_unilateral"
  std::string title;                                             ///< "Unilateral popliteal angle"
  std::vector<std::string> aliases;                              ///< earlier names of the same test
  std::map<std::string, double> posture_deg, contralateral_deg;  ///< coordinates without side
  /// Coordinates that move together, degrees each per degree of the movement; each halts at its own stop.
  std::map<std::string, double> moves;
  std::map<std::string, double> reads;  ///< angle = offset + sum of factor * coordinate
  double read_offset_deg = 0;
  double from_deg = 0, to_deg = 0;  ///< of the movement; to_deg where nobody goes
  double threshold_Nm = 0;       ///< moment against the movement at which the examiner stops, for `threshold_mass_kg`
  double threshold_mass_kg = 0;  ///< see scaledThreshold_Nm()
  double threshold_band_share = 0;                     ///< 95 % of examiners stop within threshold * (1 -+ this)
  std::map<std::string, TestNorm, std::less<>> norms;  ///< by preset
  std::vector<AgeNorm> norms_by_age;
  std::string limited_by;  ///< structures that are expected to hold
  std::string source, confidence;
  std::optional<FormRow> form;  ///< nullopt: not asked of a patient

  /// Posture that the test is done in, the moving coordinates at the start.
  Posture posture(const Skeleton& skeleton, char side) const;
  std::map<std::string, double> sidedPosture(const Skeleton& skeleton, char side) const;
  /// An angle as the form writes it; the angle itself without a form.
  double written_deg(double angle_deg) const { return form ? form->written_deg(angle_deg) : angle_deg; }
};

/// Units (without side) whose lengths change together, e.g. "hamstrings".
struct LengthGroup {
  std::string name, title;
  std::vector<std::string> units;
};

/// What one joint does to another: the difference of two tests.
struct TestCoupling {
  std::string id, title;
  std::string first, second;      ///< tests
  double sign = 1;                ///< the difference is sign * (first - second)
  bool must_be_positive = false;  ///< whatever the figures: the relation itself is anatomy
  std::map<std::string, TestNorm, std::less<>> norms;
  std::string source;
};

/// Two written angles of one side that no body has: first - second (or their sum) outside of the interval.
struct TestContradiction {
  std::string first, second;  ///< tests of the form
  bool sum = false;
  double least_deg = -std::numeric_limits<double>::infinity(), most_deg = std::numeric_limits<double>::infinity();
  std::string text;  ///< "more dorsiflexion with the knee extended than flexed"
};

/// A row of the norms that the model cannot be asked, and why.
struct TestNotAsked {
  std::string id, reason;
};

struct ClinicalTests {
  std::vector<ClinicalTest> tests;
  std::vector<LengthGroup> groups;
  std::vector<TestCoupling> couplings;
  std::vector<TestContradiction> contradictions;
  std::vector<TestNotAsked> not_asked;
  std::string thresholds;        ///< what the thresholds rest on
  double reference_mass_kg = 0;  ///< body that the thresholds are stated for
  double length_sd_m = 0;        ///< of a muscle's path, from the error of the bones
  std::string length_sd_source;

  const ClinicalTest& test(std::string_view id) const;    ///< by id or alias. @throws InputError with the nearest ids
  const LengthGroup& group(std::string_view name) const;  ///< @throws InputError with the nearest names
  std::vector<const ClinicalTest*> form() const;          ///< tests of the examination, in the file's order
};

/// @throws InputError: file, entry, expected, found; also for groups and tests that are named but not there.
ClinicalTests loadClinicalTests(const std::filesystem::path& resource_dir);
/// The same, and every coordinate is one of `skeleton`.
ClinicalTests loadClinicalTests(const std::filesystem::path& resource_dir, const Skeleton& skeleton);

/// Whose norms count.
struct NormGroup {
  std::string preset;           ///< of adults: "average-adult"
  std::optional<double> age_y;  ///< nullopt: taken for an adult
  std::string sex;              ///< "F", "M" or not known
};
/// The norm by age if there is one, else the preset's; unknown (TestNorm::known()) if neither is there.
TestNorm normOf(const ClinicalTest& test, const NormGroup& who);

}  // namespace sinew
