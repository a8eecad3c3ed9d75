#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include <QImage>

#include "app/widgets/stage_page.h"

class QLabel;
class QPushButton;
class QScrollArea;

namespace sinew {

/// The report as it will be printed, and its export.
class ReportPage : public StagePage {
  Q_OBJECT
 public:
  /// Pictures of all pages of the case's report, `width_px` wide. @throws InputError if there is none to show.
  using Renderer = std::function<std::vector<QImage>(Workspace&, int width_px)>;
  ReportPage(Workspace& workspace, Renderer renderer);

  void exportPdf(const std::filesystem::path& file);

 protected:
  void refresh() override;

 private:
  void showPages();

  Renderer renderer_;
  QPushButton* export_;
  QScrollArea* scroll_;
  QWidget* pages_;
  QLabel* placeholder_;
};

}  // namespace sinew
