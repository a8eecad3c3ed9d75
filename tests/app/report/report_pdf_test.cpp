#include "app/report/report_pdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QImage>
#include <array>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "app/plot/gui_application.h"
#include "app/report/report_layout.h"
#include "app/report/table_layout.h"
#include "core/error.h"
#include "core/file.h"
#include "tests/app/report/sample_document.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string outputOf(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> block;
  while (const auto n = fread(block.data(), 1, block.size(), pipe)) text.append(block.data(), n);
  pclose(pipe);
  return text;
}
bool haveTool(const std::string& tool) {
  return !outputOf("command -v " + tool).empty();
}

std::vector<std::string> pagesOf(const std::string& text) {
  std::vector<std::string> pages{""};
  for (const char c : text)
    if (c == '\f')
      pages.emplace_back();
    else
      pages.back() += c;
  if (pages.back().empty()) pages.pop_back();
  return pages;
}

/// One PDF for all tests of the suite: drawing the pictures takes a moment.
class ReportPdf : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    unsetenv("DISPLAY");
    folder_ = new test::TemporaryFolder;
    document_ = new ReportDocument{test::sampleDocument()};
    writeReportPdf(*document_, pdf());
    if (const char* keep = std::getenv("SINEW_KEEP_REPORT"))
      std::filesystem::copy_file(pdf(), keep, std::filesystem::copy_options::overwrite_existing);
  }
  static void TearDownTestSuite() {
    delete document_;
    delete folder_;
  }
  static std::filesystem::path pdf() { return *folder_ / "report.pdf"; }
  static std::string text() { return outputOf("pdftotext -layout '" + pdf().string() + "' -"); }

  static inline test::TemporaryFolder* folder_ = nullptr;
  static inline ReportDocument* document_ = nullptr;
};

/// A locale other than "C" that every machine has stands for those with a decimal comma.
TEST(HaveGuiApplication, KeepsTheNumberFormatFromTheUsersLocale) {
  setenv("LC_ALL", "C.UTF-8", 1);
  haveGuiApplication();
  EXPECT_STREQ(std::setlocale(LC_NUMERIC, nullptr), "C");
  unsetenv("LC_ALL");
}

TEST_F(ReportPdf, EveryPageSaysThatItIsNoMedicalDevice) {
  if (!haveTool("pdftotext")) GTEST_SKIP() << "pdftotext (poppler-utils) is not there";
  const auto pages = pagesOf(text());
  ASSERT_GE(pages.size(), 3u);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    EXPECT_THAT(pages[i], HasSubstr("not a medical device"));
    EXPECT_THAT(pages[i], HasSubstr("page " + std::to_string(i + 1) + " of " + std::to_string(pages.size())));
  }
}

TEST_F(ReportPdf, FirstPageHoldsFiguresIntervalsAndWhatIsMissing) {
  if (!haveTool("pdftotext")) GTEST_SKIP() << "pdftotext (poppler-utils) is not there";
  const auto first = pagesOf(text()).at(0);
  for (const char* expected : {"P-0042", "18 y 2 m", "Femur length", "441 (439 to 443)", "38.5 (33.5 to 43.5)",
                               "undetermined", "not measured", "Unilateral popliteal angle", "Hamstrings", "0.91",
                               "Frontal radiograph", "100 mm", "0.21 px RMS", "SHA-256 0123456789ab", "Warnings (3)"})
    EXPECT_THAT(first, HasSubstr(expected));
}

TEST_F(ReportPdf, FontsAreEmbeddedAndKoreanNamesReadable) {
  if (!haveTool("pdffonts")) GTEST_SKIP() << "pdffonts (poppler-utils) is not there";
  const auto fonts = outputOf("pdffonts '" + pdf().string() + "'");
  EXPECT_THAT(fonts, HasSubstr("DejaVuSans"));
  EXPECT_THAT(fonts, Not(HasSubstr(" no  no ")));
  if (outputOf("fc-list :lang=ko family").empty()) GTEST_SKIP() << "no Korean font (fonts-nanum) is there";
  EXPECT_THAT(text(), HasSubstr("홍 길동"));
}

TEST_F(ReportPdf, MetadataHoldsNoPatientData) {
  const std::string bytes = readFile(pdf());
  EXPECT_EQ(bytes.substr(0, 5), "%PDF-");
  for (const char* secret : {"Gildong", "P-0042"}) EXPECT_EQ(bytes.find(secret), std::string::npos);
  EXPECT_NE(bytes.find("pdfaid"), std::string::npos);  // PDF/A's own metadata
  if (!haveTool("pdfinfo")) GTEST_SKIP() << "pdfinfo (poppler-utils) is not there";
  const auto info = outputOf("pdfinfo '" + pdf().string() + "'");
  EXPECT_THAT(info, Not(HasSubstr("Hong")));
  EXPECT_THAT(info, HasSubstr("A4"));
}

TEST_F(ReportPdf, SameDocumentSamePages) {
  const auto a = reportPreview(*document_, 60), b = reportPreview(*document_, 60);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i] == b[i]) << "page " << i + 1;
}

TEST_F(ReportPdf, MarginsStayWhiteOnEveryPage) {
  // What leaves the printable area is cut off by a printer: nothing may be drawn there.
  for (const auto& page : reportPreview(*document_, 80)) {
    const double px_mm = page.width() / kPageWidth_mm;
    const int margin = int(6 * px_mm);
    for (int v = 0; v < page.height(); ++v)
      for (int u = 0; u < page.width(); ++u) {
        const bool inside = u >= margin && v >= margin && u < page.width() - margin && v < page.height() - margin;
        if (inside) continue;
        ASSERT_EQ(page.pixel(u, v) & 0xffffff, 0xffffffu) << u / px_mm << " mm, " << v / px_mm << " mm";
      }
  }
}

TEST_F(ReportPdf, AnUnwritableFileIsToldAndLeavesNothing) {
  writeFileAtomically(*folder_ / "file", "not a folder");
  EXPECT_THROW(writeReportPdf(*document_, *folder_ / "file/report.pdf"), InputError);
  EXPECT_EQ(readFile(*folder_ / "file"), "not a folder");
}

TEST_F(ReportPdf, CrowdedSummaryMovesTablesToTheNextPageAndStaysWhole) {
  ReportDocument crowded = *document_;
  for (int i = 0; i < 20; ++i) crowded.report.exam.rows.push_back(crowded.report.exam.rows[0]);
  EXPECT_GE(layOutReport(crowded).size(), layOutReport(*document_).size());
  const auto file = *folder_ / "crowded.pdf";
  writeReportPdf(crowded, file);
  if (!haveTool("pdftotext")) GTEST_SKIP() << "pdftotext (poppler-utils) is not there";
  const auto pages = pagesOf(outputOf("pdftotext -layout '" + file.string() + "' -"));
  EXPECT_THAT(pages.at(0), HasSubstr("Femur length"));
  EXPECT_THAT(pages.at(0), HasSubstr("SHA-256"));  // the footer is still there
  EXPECT_THAT(pages.at(0) + pages.at(1), HasSubstr("Hamstrings"));
}

TEST_F(ReportPdf, TablesFillTheirWidthAndGrowWithTheirText) {
  ReportTable table{"", {"A", "B"}, {{"short", "short"}}, "", {}, {}};
  const double one_line = TableLayout(table, 60, 2).rowHeight_mm(0);
  table.rows[0][1] =
      "a text that is far too long for the half of sixty millimetres and so must be wrapped into lines";
  EXPECT_GT(TableLayout(table, 60, 2).rowHeight_mm(0), 1.6 * one_line);
  EXPECT_NEAR(TableLayout(table, 300, 2).rowHeight_mm(0), one_line, 1e-9);
}

}  // namespace
}  // namespace sinew
