#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "clinical/case.h"
#include "core/model/model.h"

namespace sinew {

/// A table of the report: cells are final text with units in the header; missing values read "not measured".
struct ReportTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::string footnote;  ///< convention, norm source
};

/// Everything the report says, before it is laid out; no pictures.
struct Report {
  std::string title;
  std::vector<std::pair<std::string, std::string>> header;  ///< label, value
  ReportTable bones, exam, muscles;
  std::vector<std::pair<std::string, std::string>> footer;  ///< version, model hash, calibration, RMS, thresholds, norms
  std::vector<std::string> warnings;
  std::string disclaimer;  ///< "Research use, not a medical device ..."
};

/// @throws InputError if a stage that the report shows is missing or stale.
Report makeReport(const Case& c, const Model& reference, const std::filesystem::path& resource_dir);

}  // namespace sinew
