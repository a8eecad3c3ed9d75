#include "app/widgets/stages/report_pages.h"

#include "app/report/report_pdf.h"

namespace sinew {

std::vector<QImage> renderReportPages(const Case& c, const std::filesystem::path& case_dir, const Model& reference,
                                      const std::filesystem::path& resource_dir, int width_px) {
  constexpr double kA4Width_inch = 210 / 25.4;
  return reportPreview(c, case_dir, reference, resource_dir, width_px / kA4Width_inch);
}

void printReport(const Case& c, const std::filesystem::path& case_dir, const std::filesystem::path& pdf,
                 const Model& reference, const std::filesystem::path& resource_dir) {
  writeReportPdf(c, case_dir, pdf, reference, resource_dir);
}

}  // namespace sinew
