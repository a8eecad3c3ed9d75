#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QImage>
#include <cstdlib>

#include "app/report/report_document.h"
#include "app/report/report_pdf.h"
#include "core/file.h"
#include "tests/support/finished_case.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

TEST(ReportOfACase, PicturesContoursAndPdfComeFromTheCase) {
  unsetenv("DISPLAY");
  const test::TemporaryFolder folder;
  const Model reference = loadReferenceModel(test::resourceDir());
  const Case c = test::finishedCase(reference, folder.path());
  const auto document = gatherReport(c, folder.path(), reference, test::resourceDir());

  for (std::size_t view = 0; view < 2; ++view) {
    const auto& picture = document.radiographs[view];
    EXPECT_GT(picture.contours.size(), 4u);
    EXPECT_GT(picture.px_per_100_mm, 100);
    // The femoral head's landmark lies inside of the femur's contour: within its extent.
    for (const auto& sighting : c.sightings) {
      if (sighting.name != "femoral_head_center_r" || sighting.view != int(view)) continue;
      double nearest_px = 1e9;
      for (const auto& contour : picture.contours)
        if (contour.bone == "femur_r")
          for (const auto& line : contour.lines)
            for (const auto& p : line) nearest_px = std::min(nearest_px, (p - sighting.uv_px).norm());
      const double radius_px = 0.25 * picture.px_per_100_mm;  // a femoral head has a radius of about 24 mm
      EXPECT_LT(nearest_px, 1.6 * radius_px) << "view " << view;
    }
  }
  EXPECT_EQ(document.radiographs[0].left_letter, "R");  // hung as if the patient faced the reader
  EXPECT_EQ(document.radiographs[0].right_letter, "L");
  ASSERT_EQ(document.plates.size(), 3u);

  const auto pdf = folder / "results/report.pdf";
  writeReportPdf(document, pdf);
  EXPECT_GT(std::filesystem::file_size(pdf), 50'000u);
  if (const char* keep = std::getenv("SINEW_KEEP_REPORT"))
    std::filesystem::copy_file(pdf, keep, std::filesystem::copy_options::overwrite_existing);
}

}  // namespace
}  // namespace sinew
