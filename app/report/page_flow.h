#pragma once
#include <vector>

#include "app/report/report_layout.h"
#include "app/report/table_layout.h"

namespace sinew {

/// Fills pages from top to bottom.
class PageFlow {
 public:
  static constexpr double kLeft_mm = 12, kRight_mm = kPageWidth_mm - 12, kTop_mm = 17,
                          kBottom_mm = kPageHeight_mm - 14;
  static constexpr double kWidth_mm = kRight_mm - kLeft_mm;

  double y_mm() const { return y_mm_; }
  double room_mm() const { return kBottom_mm - y_mm_; }
  void newPage();
  /// New page unless `height_mm` fits on this one.
  void need(double height_mm);
  void skip(double height_mm) { y_mm_ += height_mm; }
  /// Draws at the current position and moves on by `height_mm`.
  void add(double height_mm, std::function<void(Ink&, double top_mm)> draw);
  /// A heading with a rule.
  void heading(const QString& text);
  /// A wrapped paragraph.
  void paragraph(const QString& text, const Ink::TextStyle& style);
  /// A table, cut between rows where a page ends; its head is repeated.
  void table(const ReportTable& table, double text_mm);

  /// The pages; every one framed by running title, page number and disclaimer.
  std::vector<ReportPage> finish(const QString& title, const QString& subject, const QString& disclaimer) &&;

 private:
  std::vector<std::vector<ReportPage>> pages_{1};
  double y_mm_ = kTop_mm;
};

}  // namespace sinew
