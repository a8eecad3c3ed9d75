#pragma once
#include <QImage>
#include <filesystem>
#include <vector>

#include "clinical/case/case.h"
#include "core/model/model.h"

namespace sinew {

/// Pages of a case's report as pictures, `width_px` wide. Safe on a thread of its own.
/// @throws InputError if a stage that the report shows is not fresh.
std::vector<QImage> renderReportPages(const Case& c, const std::filesystem::path& case_dir, const Model& reference,
                                      const std::filesystem::path& resource_dir, int width_px);

/// Draws the report to a PDF file.
void printReport(const Case& c, const std::filesystem::path& case_dir, const std::filesystem::path& pdf,
                 const Model& reference, const std::filesystem::path& resource_dir);

}  // namespace sinew
