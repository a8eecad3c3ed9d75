#include "app/report/report_layout.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "app/plot/moment_plot.h"
#include "app/report/page_flow.h"
#include "app/scene/palette.h"

namespace sinew {
namespace {

using Document = std::shared_ptr<const ReportDocument>;
using Pairs = std::vector<std::pair<std::string, std::string>>;

constexpr double kSmallest_mm = 2.05, kLargest_mm = 2.4, kAnnexText_mm = 2.3, kPairRow_mm = 3.7;
constexpr double kMinPictures_mm = 62, kPictureGap_mm = 3.5, kCaption_mm = 4, kColourBar_mm = 5.5;

QString q(const std::string& text) {
  return QString::fromStdString(text);
}

/// Label and value pairs, top to bottom in columns that are as wide as their text asks for.
void drawPairs(Ink& ink, const QRectF& box_mm, const Pairs& pairs, int columns, double size_mm) {
  const int rows = (int(pairs.size()) + columns - 1) / columns;
  std::vector<double> label_mm(std::size_t(columns), 0), value_mm(std::size_t(columns), 0);
  const Ink::TextStyle label_style{.size_mm = size_mm, .colour = shade::kMuted, .wrap = false};
  const Ink::TextStyle value_style{.size_mm = size_mm, .bold = true, .wrap = false};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t c = i / std::size_t(rows);
    label_mm[c] = std::max(label_mm[c], Ink::textWidth_mm(q(pairs[i].first), label_style) + 2);
    value_mm[c] = std::max(value_mm[c], Ink::textWidth_mm(q(pairs[i].second), value_style) + 3);
  }
  double asked = 0, labels = 0;
  for (std::size_t c = 0; c < label_mm.size(); ++c) asked += label_mm[c] + value_mm[c], labels += label_mm[c];
  const double spare = (box_mm.width() - asked) / columns;
  const double shrink = std::min(1.0, (box_mm.width() - labels) / (asked - labels));  // of the values, if too long
  double x = box_mm.left();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t c = i / std::size_t(rows);
    if (i > 0 && i % std::size_t(rows) == 0) x += label_mm[c - 1] + shrink * value_mm[c - 1] + std::max(0.0, spare);
    const double y = box_mm.top() + kPairRow_mm * double(i % std::size_t(rows));
    ink.text({x, y, label_mm[c], kPairRow_mm}, q(pairs[i].first), label_style);
    auto style = value_style;
    style.size_mm *= shrink;  // smaller letters rather than an end cut off
    ink.text({x + label_mm[c], y, shrink * value_mm[c], kPairRow_mm}, q(pairs[i].second), style);
  }
}

double pairsHeight_mm(const Pairs& pairs, int columns) {
  return kPairRow_mm * ((int(pairs.size()) + columns - 1) / columns);
}

void drawColourBar(Ink& ink, const QRectF& box_mm) {
  constexpr int kSteps = 40;
  const double width = box_mm.width() / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Rgb c = divergingColour((i + 0.5) / kSteps);
    ink.fill({box_mm.left() + i * width, box_mm.top(), width * 1.05, 1.6},
             QColor::fromRgbF(float(c.r), float(c.g), float(c.b)));
  }
  const Ink::TextStyle style{.size_mm = 1.8, .align = Qt::AlignHCenter | Qt::AlignTop, .wrap = false};
  const std::pair<double, const char*> labels[] = {{0, "0.8 short"}, {0.5, "1"}, {1, "1.2 long"}};
  for (const auto& [t, label] : labels)
    ink.text({box_mm.left() + t * box_mm.width() - 8, box_mm.top() + 1.8, 16, 3}, label, style);
}

void drawPlate(Ink& ink, const QRectF& box_mm, const ModelPlate& plate, bool colour_bar) {
  constexpr double kTitle_mm = 3.2;
  const double bar_mm = colour_bar ? kColourBar_mm : 0;
  ink.text({box_mm.left(), box_mm.top(), box_mm.width(), kTitle_mm}, plate.title,
           {.size_mm = 2.1, .bold = true, .align = Qt::AlignHCenter, .wrap = false});
  const QRectF room = box_mm.adjusted(0, kTitle_mm, 0, -bar_mm);
  const double scale = std::min(room.width() / plate.image.width(), room.height() / plate.image.height());
  const QSizeF size{scale * plate.image.width(), scale * plate.image.height()};
  ink.image({room.center().x() - size.width() / 2, room.top(), size.width(), size.height()}, plate.image);
  if (colour_bar) drawColourBar(ink, {box_mm.left() + 5, box_mm.bottom() - 5, box_mm.width() - 10, 2});
}

/// Width over height of every picture, radiographs first.
std::vector<double> pictureShapes(const ReportDocument& d) {
  std::vector<double> shapes;
  for (const auto& r : d.radiographs) shapes.push_back(double(r.image.width()) / r.image.height());
  for (const auto& p : d.plates) shapes.push_back(std::max(0.30, double(p.image.width()) / p.image.height()));
  return shapes;
}

/// Height at which the pictures side by side fill the page's width.
double naturalPictures_mm(const ReportDocument& d) {
  const auto shapes = pictureShapes(d);
  const double total = std::accumulate(shapes.begin(), shapes.end(), 0.0);
  return (PageFlow::kWidth_mm - kPictureGap_mm * double(shapes.size() - 1)) / total + kCaption_mm + 3.2;
}

void drawPictures(Ink& ink, const QRectF& box_mm, const ReportDocument& d) {
  const QRectF room = box_mm.adjusted(0, 0, 0, -kCaption_mm);
  // Every picture gets the width of its own shape, so that all have about the same height.
  const auto shapes = pictureShapes(d);
  const double total = std::accumulate(shapes.begin(), shapes.end(), 0.0);
  const double usable = room.width() - kPictureGap_mm * double(shapes.size() - 1);
  double x = room.left();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double width = usable * shapes[i] / total;
    const QRectF box{x, room.top(), width, room.height()};
    if (i < d.radiographs.size())
      drawRadiograph(ink, box, d.radiographs[i]);
    else
      drawPlate(ink, box, d.plates[i - d.radiographs.size()], i + 1 == shapes.size());
    x += width + kPictureGap_mm;
  }
  ink.text({box_mm.left(), box_mm.bottom() - 3.2, box_mm.width(), 3},
           "Contours: fitted bones, right solid, left dashed. Scale bar: at the depth of the hips. Models: orange = "
           "mechanical axes of femur and tibia, blue = hip to ankle.",
           {.size_mm = 1.75, .colour = shade::kMuted, .wrap = false});
}

double tableHeight_mm(const ReportTable& table, double text_mm) {
  return TableLayout{table, PageFlow::kWidth_mm, text_mm}.height_mm() + 2.2;
}

double tablesHeight_mm(const std::vector<const ReportTable*>& tables, double text_mm) {
  double height = 0;
  for (const auto* t : tables) height += tableHeight_mm(*t, text_mm);
  return height;
}

/// Size of letters for each table: as large as the room allows, but never so large that cells wrap which would not.
std::vector<double> textSizes_mm(const std::vector<const ReportTable*>& tables, double room_mm) {
  std::vector<double> sizes(tables.size(), kSmallest_mm);
  double spare = room_mm - tablesHeight_mm(tables, kSmallest_mm);
  constexpr double kStep_mm = 0.05;
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const double larger = sizes[i] + kStep_mm;
      const double now = tableHeight_mm(*tables[i], sizes[i]), then = tableHeight_mm(*tables[i], larger);
      const bool wraps = then > now * larger / sizes[i] + 1;
      if (larger > kLargest_mm || wraps || then - now > spare) continue;
      spare -= then - now;
      sizes[i] = larger;
      grown = true;
    }
  }
  return sizes;
}

QString warningText(const std::vector<std::string>& warnings, std::size_t most) {
  if (warnings.empty()) return "Warnings: none.";
  QString text = "Warnings (" + QString::number(warnings.size()) + "): ";
  for (std::size_t i = 0; i < std::min(most, warnings.size()); ++i) {
    QString one = q(warnings[i]);
    if (one.endsWith('.')) one.chop(1);
    text += (i ? "; " : "") + one;
  }
  return text + (warnings.size() > most ? "; more in the annex." : ".");
}

/// Header, pictures, tables, footer on one page. What does not fit moves to the annex.
void summaryPage(PageFlow& flow, const Document& d) {
  const Report& r = d->report;
  const double header = pairsHeight_mm(r.header, 4) + 1.5;
  const double footer = pairsHeight_mm(r.footer, 2);
  const Ink::TextStyle warning_style{.size_mm = 2.0, .bold = !r.warnings.empty()};
  const QString warnings = warningText(r.warnings, 2);
  const double below = footer + Ink::textHeight_mm(warnings, PageFlow::kWidth_mm, warning_style) + 4;

  std::vector<const ReportTable*> tables{&r.bones, &r.exam, &r.muscles};
  std::vector<const ReportTable*> moved;
  while (tables.size() > 1 &&
         flow.room_mm() - header - below - tablesHeight_mm(tables, kSmallest_mm) < kMinPictures_mm) {
    moved.insert(moved.begin(), tables.back());
    tables.pop_back();
  }
  flow.add(header, [d](Ink& ink, double top_mm) {
    drawPairs(ink, {PageFlow::kLeft_mm, top_mm, PageFlow::kWidth_mm, 20}, d->report.header, 4, 2.25);
  });
  // The pictures as large as the page is wide if the tables let them; then the tables' letters as large as fits.
  const double room = flow.room_mm() - below, natural = naturalPictures_mm(*d);
  const double pictures = std::min(natural, std::max(kMinPictures_mm, room - tablesHeight_mm(tables, kSmallest_mm)));
  const auto text_mm = textSizes_mm(tables, room - pictures);
  flow.add(pictures, [d, pictures](Ink& ink, double top_mm) {
    drawPictures(ink, {PageFlow::kLeft_mm, top_mm, PageFlow::kWidth_mm, pictures}, *d);
  });
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto layout = std::make_shared<const TableLayout>(*tables[i], PageFlow::kWidth_mm, text_mm[i]);
    flow.add(layout->height_mm() + 2.2,
             [layout](Ink& ink, double top_mm) { layout->drawAll(ink, PageFlow::kLeft_mm, top_mm); });
  }
  flow.add(footer + 1, [d](Ink& ink, double top_mm) {
    ink.line({PageFlow::kLeft_mm, top_mm}, {PageFlow::kRight_mm, top_mm}, 0.15, shade::kRule);
    drawPairs(ink, {PageFlow::kLeft_mm, top_mm + 0.8, PageFlow::kWidth_mm, 20}, d->report.footer, 2, 2.0);
  });
  flow.paragraph(warnings, warning_style);
  if (moved.empty()) return;
  flow.newPage();
  for (const auto* t : moved) flow.table(*t, kAnnexText_mm);
}

void momentPages(PageFlow& flow, const Document& d) {
  const auto& plots = d->report.passive_moments;
  if (plots.empty()) return;
  flow.heading("Examination on the model: passive moment against the movement");
  constexpr double kHeight_mm = 55, kGap_mm = 6;
  for (std::size_t first = 0; first < plots.size(); first += 2) {
    if (kHeight_mm + 8 > flow.room_mm()) flow.newPage();
    flow.add(kHeight_mm, [d, first](Ink& ink, double top_mm) {
      const double width = (PageFlow::kWidth_mm - kGap_mm) / 2;
      for (std::size_t i = first; i < std::min(first + 2, d->report.passive_moments.size()); ++i)
        drawMomentPlot(ink,
                       {PageFlow::kLeft_mm + double(i - first) * (width + kGap_mm), top_mm, width, kHeight_mm - 1},
                       d->report.passive_moments[i]);
    });
  }
  flow.add(8, [](Ink& ink, double top_mm) {
    drawMomentLegend(ink, {PageFlow::kLeft_mm, top_mm, PageFlow::kWidth_mm, 6});
  });
}

void textPages(PageFlow& flow, const Report& report) {
  flow.heading("Warnings, conventions and sources");
  const Ink::TextStyle style{.size_mm = kAnnexText_mm};
  const Ink::TextStyle title{.size_mm = kAnnexText_mm, .bold = true, .colour = shade::kAccent};
  flow.paragraph("Warnings", title);
  if (report.warnings.empty()) flow.paragraph("none", style);
  for (const auto& warning : report.warnings) flow.paragraph("\u2022 " + q(warning), style);
  for (const auto* table : {&report.bones, &report.exam, &report.muscles}) {
    if (table->sources.empty()) continue;
    flow.skip(1.5);
    flow.paragraph(q(table->title) + ": conventions and norm sources", title);
    for (const auto& source : table->sources) flow.paragraph("\u2022 " + q(source), style);
  }
}

}  // namespace

std::vector<ReportPage> layOutReport(const ReportDocument& document) {
  const auto d = std::make_shared<const ReportDocument>(document);
  PageFlow flow;
  summaryPage(flow, d);
  flow.newPage();
  momentPages(flow, d);
  flow.need(60);
  flow.heading("Annex");
  for (const auto& table : d->report.annexes) flow.table(table, kAnnexText_mm);
  textPages(flow, d->report);

  QString subject;
  for (const auto& [label, value] : d->report.header)
    if (label == "ID") subject = "ID " + q(value) + "   ";
  return std::move(flow).finish(q(d->report.title), subject, q(d->report.disclaimer));
}

}  // namespace sinew
