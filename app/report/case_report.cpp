#include <QImage>

#include "app/report/report_document.h"
#include "app/report/report_pdf.h"

namespace sinew {

void writeReportPdf(const Case& c, const std::filesystem::path& case_dir, const std::filesystem::path& pdf,
                    const Model& reference, const std::filesystem::path& resource_dir) {
  writeReportPdf(gatherReport(c, case_dir, reference, resource_dir), pdf);
}

std::vector<QImage> reportPreview(const Case& c, const std::filesystem::path& case_dir, const Model& reference,
                                  const std::filesystem::path& resource_dir, double dots_per_inch) {
  return reportPreview(gatherReport(c, case_dir, reference, resource_dir), dots_per_inch);
}

}  // namespace sinew
