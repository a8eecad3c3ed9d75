#pragma once
#include <QImage>
#include <vector>

#include "app/model/workspace.h"

namespace sinew {

/// Draws a case's report to a PDF file: what the report stage calls, also on a thread of its own.
Workspace::ReportWriter reportWriter(const std::filesystem::path& resource_dir);

/// The same pages as pictures, `width_px` wide. @throws InputError if a stage that the report shows is not fresh.
std::vector<QImage> renderReportPages(Workspace& workspace, int width_px);

}  // namespace sinew
