#include "app/report/page_flow.h"

#include <memory>

namespace sinew {

void PageFlow::newPage() {
  pages_.emplace_back();
  y_mm_ = kTop_mm;
}

void PageFlow::need(double height_mm) {
  if (height_mm > room_mm() && !pages_.back().empty()) newPage();
}

void PageFlow::add(double height_mm, std::function<void(Ink&, double)> draw) {
  pages_.back().push_back([draw = std::move(draw), top = y_mm_](Ink& ink) { draw(ink, top); });
  y_mm_ += height_mm;
}

void PageFlow::heading(const QString& text) {
  need(20);  // never alone at the foot of a page
  add(7.5, [text](Ink& ink, double top_mm) {
    ink.text({kLeft_mm, top_mm, kWidth_mm, 6}, text,
             {.size_mm = 3.6, .bold = true, .colour = shade::kAccent, .wrap = false});
    ink.line({kLeft_mm, top_mm + 5.6}, {kRight_mm, top_mm + 5.6}, 0.2, shade::kAccent);
  });
}

void PageFlow::paragraph(const QString& text, const Ink::TextStyle& style) {
  const double height = Ink::textHeight_mm(text, kWidth_mm, style);
  need(height);
  add(height + 0.8, [=](Ink& ink, double top_mm) {
    ink.text({kLeft_mm, top_mm, kWidth_mm, height + 2}, text, style);
  });
}

void PageFlow::table(const ReportTable& content, double text_mm) {
  const auto layout = std::make_shared<const TableLayout>(content, kWidth_mm, text_mm);
  const auto head = [&](bool continued) {
    add(layout->titleHeight_mm() + layout->headHeight_mm(), [layout, continued](Ink& ink, double top_mm) {
      layout->drawHead(ink, kLeft_mm, layout->drawTitle(ink, kLeft_mm, top_mm, continued));
    });
  };
  const double first = layout->rowCount() > 0 ? layout->rowHeight_mm(0) : 0;
  need(layout->titleHeight_mm() + layout->headHeight_mm() + first + 3);
  head(false);
  for (int row = 0; row < layout->rowCount(); ++row) {
    if (layout->rowHeight_mm(row) > room_mm()) {
      newPage();
      head(true);
    }
    add(layout->rowHeight_mm(row),
        [layout, row](Ink& ink, double top_mm) { layout->drawRow(ink, kLeft_mm, top_mm, row); });
  }
  need(layout->footnoteHeight_mm());
  add(layout->footnoteHeight_mm(),
      [layout](Ink& ink, double top_mm) { layout->drawFootnote(ink, kLeft_mm, top_mm); });
  skip(3.5);
}

std::vector<ReportPage> PageFlow::finish(const QString& title, const QString& subject, const QString& disclaimer) && {
  std::vector<ReportPage> framed;
  const auto count = pages_.size();
  for (std::size_t i = 0; i < count; ++i)
    framed.push_back([=, number = i + 1, items = std::move(pages_[i])](Ink& ink) {
      const double edge = 8;
      ink.text({kLeft_mm, edge, kWidth_mm, 6}, title,
               {.size_mm = number == 1 ? 4.6 : 3.0, .bold = true, .colour = shade::kAccent, .wrap = false});
      ink.text({kLeft_mm, edge + 0.6, kWidth_mm, 5},
               subject + "page " + QString::number(number) + " of " + QString::number(count),
               {.size_mm = 2.3, .colour = shade::kMuted, .align = Qt::AlignRight | Qt::AlignTop, .wrap = false});
      ink.line({kLeft_mm, 14.6}, {kRight_mm, 14.6}, 0.35, shade::kAccent);
      for (const auto& item : items) item(ink);
      const double foot = kPageHeight_mm - 11;
      ink.line({kLeft_mm, foot}, {kRight_mm, foot}, 0.15, shade::kRule);
      ink.text({kLeft_mm, foot + 0.8, kWidth_mm, 4}, disclaimer,
               {.size_mm = 2.4, .bold = true, .align = Qt::AlignHCenter | Qt::AlignTop, .wrap = false});
    });
  return framed;
}

}  // namespace sinew
