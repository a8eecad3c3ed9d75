#pragma once
#include <filesystem>
#include <vector>

#include "clinical/case/case.h"
#include "core/model/model.h"

class QImage;

namespace sinew {

struct ReportDocument;  // report_document.h

/// Writes the report of a finished case as a PDF/A-1b file of A4 pages: summary page and annexes. Needs no display (a
/// QGuiApplication of the platform "offscreen" is made if the process has none; then call it on the main thread).
/// Atomic: `pdf` is the old or the new file, whole. Neither the file's metadata nor its name hold patient data.
/// @throws InputError if a stage is missing or stale (see makeReport()), a file of the case is damaged, the machine
/// cannot draw (see renderOffscreen()) or the file cannot be written.
void writeReportPdf(const Case& c, const std::filesystem::path& case_dir, const std::filesystem::path& pdf,
                    const Model& reference, const std::filesystem::path& resource_dir);

/// The same pages as pictures, for the screen.
std::vector<QImage> reportPreview(const Case& c, const std::filesystem::path& case_dir, const Model& reference,
                                  const std::filesystem::path& resource_dir, double dots_per_inch = 110);

// The same in two steps: gatherReport() is the long part, these only draw.
void writeReportPdf(const ReportDocument& document, const std::filesystem::path& pdf);
std::vector<QImage> reportPreview(const ReportDocument& document, double dots_per_inch = 110);

}  // namespace sinew
