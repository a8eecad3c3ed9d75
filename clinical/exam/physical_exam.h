#pragma once
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"
#include "core/rom/tests/exam_test.h"

namespace sinew {

/// One line of the examination form.
struct ExamEntry {
  std::string test;  ///< ExamTest::id
  char side = 'r';
  std::optional<double> measured_deg;  ///< by the test's convention; nullopt = not measured
  std::string note;                    ///< why not, end-feel, pain, ...
  std::optional<double> threshold_Nm;  ///< overrides the test's
  friend bool operator==(const ExamEntry&, const ExamEntry&) = default;
};

struct PhysicalExam {
  std::string examiner;
  std::string date;  ///< ISO 8601
  std::vector<ExamEntry> entries;
  friend bool operator==(const PhysicalExam&, const PhysicalExam&) = default;
};

/// Refuses impossible values (@throws InputError: test, expected range, found), returns the doubts.
Warnings checkExam(const PhysicalExam& exam, const ExamProtocol& protocol);

/// Versioned JSON ("sinew.exam", version 1).
PhysicalExam loadExam(const std::filesystem::path& file);
void saveExam(const PhysicalExam& exam, const std::filesystem::path& file);

struct LengthChange {
  std::string muscle;  ///< unit
  double factor = 1;   ///< of fibre and tendon length; 1 = unchanged
  friend bool operator==(const LengthChange&, const LengthChange&) = default;
};

/// The virtual re-examination: one line a test and side.
struct ExamComparison {
  std::string test;
  char side = 'r';
  std::optional<double> measured_deg;
  double simulated_before_deg = std::numeric_limits<double>::quiet_NaN();
  double simulated_after_deg = std::numeric_limits<double>::quiet_NaN();
  double residual_deg = std::numeric_limits<double>::quiet_NaN();  ///< measured minus after; NaN if not measured
  double threshold_Nm = 0;
  bool stopped_by_joint = false;
  std::vector<std::string> limiting_muscles;
  std::vector<LengthChange> changed;  ///< units of this test's groups
};

struct ExamFit {
  Outcome outcome = Outcome::NotRun;
  std::vector<ExamComparison> tests;
  std::map<std::string, double> length_factors;  ///< by unit, only those that changed
  double seconds = 0;
  Warnings warnings;
};

/// Solves one length factor per muscle group and side so that all simulated tests meet the measured ones: bounded
/// least squares (0.6-1.4), weights 1 / measurement SD, a weak pull to 1 so that untested groups stay. What cannot be
/// met together remains as residual, test by test. Thresholds scale with body mass (mass_kg / 75).
ExamFit applyExam(const Model& model, const PhysicalExam& exam, const ExamProtocol& protocol, double mass_kg,
                  const Job& job = {});

/// The model with the lengths of a fit.
Model withLengthFactors(const Model& model, const std::map<std::string, double>& factors);

}  // namespace sinew
