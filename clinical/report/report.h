#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "clinical/case/case.h"
#include "core/model/model.h"

namespace sinew {

/// A cell that continues the one to its left.
inline constexpr const char* kSpan = "<span>";

/// A table of the report: cells are final text with units in the header; missing values read "not measured" or
/// "undetermined", never blank.
struct ReportTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::string footnote;              ///< what the marks mean: stands under the table
  std::vector<std::string> sources;  ///< conventions and norm sources, for the annex
  /// Right and left z-score of each row, for a bar; NaN = no norm. Empty: the table has no bars.
  std::vector<std::array<double, 2>> z_scores;
};

/// Passive moment against the movement of one test, for a plot. Angles by the test's convention.
struct PassiveMomentPlot {
  std::string title;  ///< test and side
  std::string convention;
  std::vector<std::pair<double, double>> before,
      after;                ///< angle [deg], moment [N m]; without and with the exam's lengths
  double measured_deg = 0;  ///< NaN = not measured
  double simulated_after_deg = 0;
  double threshold_Nm = 0;
  double norm_low_deg = 0, norm_high_deg = 0;  ///< mean -+ 2 SD; NaN = none
};

/// Everything the report says, before it is laid out; no pictures.
struct Report {
  std::string title;
  std::vector<std::pair<std::string, std::string>> header;  ///< label, value
  ReportTable bones, exam, muscles;
  std::vector<ReportTable>
      annexes;  ///< definitions, lengths by unit, landmark residuals, truth of a synthetic patient
  std::vector<PassiveMomentPlot> passive_moments;
  std::vector<std::pair<std::string, std::string>>
      footer;  ///< version, model hash, calibration, RMS, thresholds, norms
  std::vector<std::string> warnings;
  std::string disclaimer;  ///< "Research use only - not a medical device ..."
};

/// `case_dir` supplies what only the image files say (date, instance UID).
/// @throws InputError if a stage that the report shows is missing or stale: one line with every reason.
Report makeReport(const Case& c, const std::filesystem::path& case_dir, const Model& reference,
                  const std::filesystem::path& resource_dir);

}  // namespace sinew
