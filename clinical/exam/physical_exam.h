#pragma once
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"
#include "core/rom/tests/clinical_tests.h"

namespace sinew {

/// One line of the examination form.
struct ExamEntry {
  std::string test;  ///< ClinicalTest::id
  char side = 'r';
  std::optional<double> measured_deg;  ///< by the form's convention; nullopt = not measured
  std::string note;                    ///< why not, end-feel, pain, ...
  std::optional<double> threshold_Nm;  ///< overrides the test's
  friend bool operator==(const ExamEntry&, const ExamEntry&) = default;
};

struct PhysicalExam {
  std::string examiner;
  std::string date;  ///< ISO 8601
  std::vector<ExamEntry> entries;
  /// A measurement inside the norm of the patient's age, or no further from its mean than its own SD, changes no
  /// length; beyond, lengths fade in. Otherwise every measurement counts as it stands.
  bool leave_in_norm = true;
  friend bool operator==(const PhysicalExam&, const PhysicalExam&) = default;
};

/// Refuses impossible values (@throws InputError: test, expected range, found), returns the doubts: unusual values,
/// and pairs of one side that contradict each other.
Warnings checkExam(const PhysicalExam& exam, const ClinicalTests& tests);

/// Versioned JSON ("sinew.exam", version 1).
PhysicalExam loadExam(const std::filesystem::path& file);
void saveExam(const PhysicalExam& exam, const std::filesystem::path& file);

struct LengthChange {
  std::string muscle;  ///< unit
  double factor = 1;   ///< of fibre and tendon length; 1 = unchanged
  friend bool operator==(const LengthChange&, const LengthChange&) = default;
};

/// The virtual re-examination: one line a test and side. Angles as the form writes them.
struct ExamComparison {
  std::string test;
  char side = 'r';
  std::optional<double> measured_deg;
  double simulated_before_deg = std::numeric_limits<double>::quiet_NaN();
  double simulated_after_deg = std::numeric_limits<double>::quiet_NaN();
  double residual_deg = std::numeric_limits<double>::quiet_NaN();  ///< measured minus after; NaN if not measured
  std::string reason;  ///< why the residual is larger than kNamedResidual_deg; else empty
  double norm_mean_deg = std::numeric_limits<double>::quiet_NaN();  ///< of the patient's age and sex
  double norm_sd_deg = std::numeric_limits<double>::quiet_NaN();
  double threshold_Nm = 0;
  bool stopped_by_joint = false;
  std::vector<std::string> limiting_muscles;
  std::vector<std::string> limited_by;  ///< muscles, capsule and ligaments, stops: SimulatedTest::limited_by
  std::vector<LengthChange> changed;    ///< units of this test's groups
};

/// Residuals above this have a reason.
inline constexpr double kNamedResidual_deg = 1;

/// How long the muscles of one group are on one side, against what this skeleton calls for.
struct GroupFactor {
  std::string group;  ///< LengthGroup::name
  char side = 'r';
  bool tested = false;  ///< a measured test names the group; otherwise nothing below is known
  double factor = 1;    ///< of fibre and tendon length
  /// 95 % interval: from the SD of the measurements, the band of the examiners' moment, the error of the bones, and
  /// the prior where the measurements say little.
  double lower95 = std::numeric_limits<double>::quiet_NaN(), upper95 = std::numeric_limits<double>::quiet_NaN();
  bool determined = false;       ///< the interval is less than half as wide as without any measurement
  double fiber_only_factor = 1;  ///< of fibre length, tendons unchanged, that meets the same tests
  friend bool operator==(const GroupFactor&, const GroupFactor&) = default;
};

struct ExamFit {
  Outcome outcome = Outcome::NotRun;
  std::vector<ExamComparison> tests;             ///< every test of the form, right then left
  std::vector<GroupFactor> groups;               ///< every group, right then left
  std::map<std::string, double> length_factors;  ///< by unit, only those that changed
  bool left_in_norm = true;                      ///< PhysicalExam::leave_in_norm of this fit
  double seconds = 0;
  Warnings warnings;
};

/// Whose examination it is.
struct ExamSubject {
  double mass_kg = 0;  ///< scales the examiner's moment, see scaledThreshold_Nm()
  std::optional<double> age_y;
  std::string sex;  ///< "F", "M" or not known
};

/// Solves one length factor per muscle group and side so that the simulated tests meet the measured ones: bounded
/// least squares (0.6-1.4), weights 1 / measurement SD, a weak pull to 1. The sides do not know of each other: a side
/// that cannot be solved is a warning and keeps its lengths. What cannot be met stays as a residual with its reason.
/// Method: docs/methods/examination.md.
ExamFit applyExam(const Model& model, const PhysicalExam& exam, const ClinicalTests& tests,
                  const ExamSubject& subject, const Job& job = {});

/// The model with the lengths of a fit.
Model withLengthFactors(const Model& model, const std::map<std::string, double>& factors);

}  // namespace sinew
