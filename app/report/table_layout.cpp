#include "app/report/table_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sinew {
namespace {

constexpr double kPad_mm = 0.9, kRowGap_mm = 0.55, kZRange = 4;

Ink::TextStyle body(double size_mm, bool bold = false) {
  return {.size_mm = size_mm, .bold = bold};
}
Ink::TextStyle small(double size_mm) {
  return {.size_mm = 0.86 * size_mm, .colour = shade::kMuted};
}
QString q(const std::string& text) {
  return QString::fromStdString(text);
}

double longestWord_mm(const QString& text, const Ink::TextStyle& style) {
  double longest = 0;
  for (const auto& word : text.split(' ')) longest = std::max(longest, Ink::textWidth_mm(word, style));
  return longest;
}

/// Bar of right and left z-scores on a scale of +-4 SD; the grey middle is +-2 SD.
void drawBars(Ink& ink, const QRectF& box, const std::array<double, 2>& z) {
  if (!std::isfinite(z[0]) && !std::isfinite(z[1])) return;
  const auto x = [&](double sd) {
    return box.center().x() + std::clamp(sd, -kZRange, kZRange) / kZRange * box.width() / 2;
  };
  const double middle = box.center().y();
  ink.fill({x(-2), middle - 0.75, x(2) - x(-2), 1.5}, shade::kHead);
  ink.line({x(-kZRange), middle}, {x(kZRange), middle}, 0.1, shade::kRule);
  ink.line({x(0), middle - 1}, {x(0), middle + 1}, 0.15, shade::kMuted);
  if (std::isfinite(z[1])) ink.disc({x(z[1]), middle}, 0.62, Qt::black, false);
  if (std::isfinite(z[0])) ink.disc({x(z[0]), middle}, 0.45, Qt::black, true);
}

}  // namespace

TableLayout::TableLayout(const ReportTable& table, double width_mm, double text_mm)
    : table_{table}, width_mm_{width_mm}, text_mm_{text_mm} {
  for (auto& row : table_.rows) row.resize(table_.columns.size(), "not measured");
  if (!table_.z_scores.empty()) bar_mm_ = 22;
  fitColumns();
  head_mm_ = heightOf(table_.columns, true) + kRowGap_mm;
  for (const auto& row : table_.rows) row_mm_.push_back(heightOf(row, false) + kRowGap_mm);
}

void TableLayout::fitColumns() {
  const double room = width_mm_ - bar_mm_;
  std::vector<double> natural, least;
  for (std::size_t c = 0; c < table_.columns.size(); ++c) {
    // A head may wrap between words; a cell asks for its whole text.
    double wish = longestWord_mm(q(table_.columns[c]), body(text_mm_, true)), must = wish;
    for (const auto& row : table_.rows) {
      if (row[c] == kSpan || (c + 1 < row.size() && row[c + 1] == kSpan)) continue;
      wish = std::max(wish, Ink::textWidth_mm(q(row[c]), body(text_mm_)));
      must = std::max(must, longestWord_mm(q(row[c]), body(text_mm_)));
    }
    natural.push_back(wish + 2 * kPad_mm);
    least.push_back(must + 2 * kPad_mm);
  }
  const double asked = std::accumulate(natural.begin(), natural.end(), 0.0);
  const double needed = std::accumulate(least.begin(), least.end(), 0.0);
  const double spare = asked - needed;
  column_mm_ = natural;
  for (std::size_t c = 0; c < natural.size(); ++c) {
    if (asked <= room)
      column_mm_[c] += (room - asked) / double(natural.size());
    else if (needed <= room && spare > 0)
      column_mm_[c] = least[c] + (natural[c] - least[c]) * (room - needed) / spare;
    else
      column_mm_[c] = least[c] * room / needed;
  }
}

double TableLayout::cellWidth_mm(const std::vector<std::string>& cells, std::size_t column) const {
  double width = column_mm_[column];
  for (std::size_t c = column + 1; c < cells.size() && cells[c] == kSpan; ++c) width += column_mm_[c];
  return width;
}

double TableLayout::heightOf(const std::vector<std::string>& cells, bool bold) const {
  double height = 1.2 * text_mm_;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (cells[c] != kSpan)
      height = std::max(height,
                        Ink::textHeight_mm(q(cells[c]), cellWidth_mm(cells, c) - 2 * kPad_mm, body(text_mm_, bold)));
  return height;
}

double TableLayout::titleHeight_mm() const {
  return table_.title.empty() ? 0 : 1.25 * text_mm_ + 1.6;
}

double TableLayout::footnoteHeight_mm() const {
  if (table_.footnote.empty()) return 0;
  return Ink::textHeight_mm(q(table_.footnote), width_mm_, small(text_mm_)) + 0.8;
}

double TableLayout::height_mm() const {
  return titleHeight_mm() + head_mm_ + std::accumulate(row_mm_.begin(), row_mm_.end(), 0.0) + footnoteHeight_mm();
}

double TableLayout::drawTitle(Ink& ink, double left_mm, double top_mm, bool continued) const {
  if (table_.title.empty()) return top_mm;
  Ink::TextStyle style{.size_mm = 1.18 * text_mm_, .bold = true, .colour = shade::kAccent, .wrap = false};
  ink.text({left_mm, top_mm, width_mm_, titleHeight_mm()}, q(table_.title) + (continued ? " (continued)" : ""),
           style);
  return top_mm + titleHeight_mm();
}

double TableLayout::drawHead(Ink& ink, double left_mm, double top_mm) const {
  ink.fill({left_mm, top_mm, width_mm_, head_mm_}, shade::kHead);
  double x = left_mm;
  for (std::size_t c = 0; c < table_.columns.size(); ++c) {
    ink.text({x + kPad_mm, top_mm + kRowGap_mm / 2, column_mm_[c] - 2 * kPad_mm, head_mm_}, q(table_.columns[c]),
             body(text_mm_, true));
    x += column_mm_[c];
  }
  if (bar_mm_ > 0) {
    ink.text({x, top_mm + kRowGap_mm / 2, bar_mm_, head_mm_}, "z  \u25CF right \u25CB left",
             {.size_mm = 0.86 * text_mm_, .align = Qt::AlignHCenter | Qt::AlignTop, .wrap = false});
    ink.text({x, top_mm + kRowGap_mm / 2 + 1.05 * text_mm_, bar_mm_, text_mm_}, "-4 ... grey +-2 ... +4 SD",
             {.size_mm = 0.66 * text_mm_, .align = Qt::AlignHCenter | Qt::AlignTop, .wrap = false});
  }
  return top_mm + head_mm_;
}

double TableLayout::drawRow(Ink& ink, double left_mm, double top_mm, int row) const {
  const auto& cells = table_.rows[std::size_t(row)];
  const double height = rowHeight_mm(row);
  if (row % 2 == 1) ink.fill({left_mm, top_mm, width_mm_, height}, shade::kBand);
  double x = left_mm;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c] != kSpan) {
      Ink::TextStyle style = body(text_mm_);
      if (cells[c].starts_with("not measured") || cells[c] == "undetermined" || cells[c] == "no norm")
        style.colour = shade::kMuted;
      if (cells[c].find("\u25B2") != std::string::npos || cells[c].find("\u25BC") != std::string::npos)
        style.bold = true;
      ink.text({x + kPad_mm, top_mm + kRowGap_mm / 2, cellWidth_mm(cells, c) - 2 * kPad_mm, height}, q(cells[c]),
               style);
    }
    x += column_mm_[c];
  }
  if (bar_mm_ > 0) drawBars(ink, {x + 1, top_mm, bar_mm_ - 2, height}, table_.z_scores[std::size_t(row)]);
  ink.line({left_mm, top_mm + height}, {left_mm + width_mm_, top_mm + height}, 0.06, shade::kRule);
  return top_mm + height;
}

double TableLayout::drawFootnote(Ink& ink, double left_mm, double top_mm) const {
  if (table_.footnote.empty()) return top_mm;
  ink.text({left_mm, top_mm + 0.5, width_mm_, footnoteHeight_mm() + 1}, q(table_.footnote), small(text_mm_));
  return top_mm + footnoteHeight_mm();
}

double TableLayout::drawAll(Ink& ink, double left_mm, double top_mm) const {
  double y = drawHead(ink, left_mm, drawTitle(ink, left_mm, top_mm, false));
  for (int row = 0; row < rowCount(); ++row) y = drawRow(ink, left_mm, y, row);
  return drawFootnote(ink, left_mm, y);
}

}  // namespace sinew
