#pragma once
#include <QString>
#include <vector>

#include "app/plot/ink.h"
#include "clinical/report/report.h"

namespace sinew {

/// A table cut to a width: columns as wide as their text asks for, long cells wrapped, first column widest.
class TableLayout {
 public:
  TableLayout(const ReportTable& table, double width_mm, double text_mm);

  double titleHeight_mm() const;
  double headHeight_mm() const { return head_mm_; }
  double rowHeight_mm(int row) const { return row_mm_[std::size_t(row)]; }
  int rowCount() const { return int(row_mm_.size()); }
  double footnoteHeight_mm() const;
  /// Title, head, all rows and footnote.
  double height_mm() const;

  // Each draws at `top_mm` and returns the next free position.
  double drawTitle(Ink& ink, double left_mm, double top_mm, bool continued) const;
  double drawHead(Ink& ink, double left_mm, double top_mm) const;
  double drawRow(Ink& ink, double left_mm, double top_mm, int row) const;
  double drawFootnote(Ink& ink, double left_mm, double top_mm) const;
  double drawAll(Ink& ink, double left_mm, double top_mm) const;

 private:
  double cellWidth_mm(const std::vector<std::string>& cells, std::size_t column) const;
  double heightOf(const std::vector<std::string>& cells, bool bold) const;
  void fitColumns();

  ReportTable table_;
  double width_mm_, text_mm_;
  std::vector<double> column_mm_;
  double bar_mm_ = 0;  ///< width of the z-score bars, 0 without
  double head_mm_ = 0;
  std::vector<double> row_mm_;
};

}  // namespace sinew
