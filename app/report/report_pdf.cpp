#include "app/report/report_pdf.h"

#include <QBuffer>
#include <QImage>
#include <QPageLayout>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <cmath>

#include "app/plot/gui_application.h"
#include "app/report/report_layout.h"
#include "core/error.h"
#include "core/file.h"

namespace sinew {
namespace {

/// The page fills the device, whatever its resolution; Ink's unit is 0.01 mm.
void paintPage(QPainter& painter, const ReportPage& page) {
  painter.setWindow(0, 0, int(kPageWidth_mm * 100), int(kPageHeight_mm * 100));
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing | QPainter::SmoothPixmapTransform);
  Ink ink{painter};
  page(ink);
}

QByteArray pdfOf(const std::vector<ReportPage>& pages) {
  QByteArray bytes;
  QBuffer buffer{&bytes};
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer{&buffer};
  writer.setPdfVersion(QPagedPaintDevice::PdfVersion_A1b);
  writer.setPageLayout({QPageSize{QPageSize::A4}, QPageLayout::Portrait, {}, QPageLayout::Millimeter});
  writer.setResolution(600);
  writer.setTitle("Sinew musculoskeletal report");  // no patient data: titles show in file lists
  writer.setCreator("Sinew");
  QPainter painter;
  if (!painter.begin(&writer)) throw InputError{"report: the PDF cannot be drawn"};
  for (std::size_t i = 0; i < pages.size(); ++i) {
    if (i > 0) writer.newPage();
    paintPage(painter, pages[i]);
  }
  painter.end();
  return bytes;
}

}  // namespace

void writeReportPdf(const ReportDocument& document, const std::filesystem::path& pdf) {
  haveGuiApplication();
  const auto bytes = pdfOf(layOutReport(document));
  writeFileAtomically(pdf, {bytes.constData(), std::size_t(bytes.size())});
}

std::vector<QImage> reportPreview(const ReportDocument& document, double dots_per_inch) {
  haveGuiApplication();
  std::vector<QImage> images;
  for (const auto& page : layOutReport(document)) {
    QImage image{int(std::lround(kPageWidth_mm / 25.4 * dots_per_inch)),
                 int(std::lround(kPageHeight_mm / 25.4 * dots_per_inch)), QImage::Format_RGB32};
    image.fill(Qt::white);
    QPainter painter{&image};
    paintPage(painter, page);
    painter.end();
    images.push_back(std::move(image));
  }
  return images;
}

}  // namespace sinew
