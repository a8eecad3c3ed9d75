#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include <QImage>

#include "app/model/job_runner.h"
#include "app/widgets/stages/stage_page.h"
#include "core/model/model.h"

class QLabel;
class QPushButton;
class QScrollArea;

namespace sinew {

/// The report as it will be printed, and its export.
class ReportStagePage : public StagePage {
  Q_OBJECT
 public:
  /// Pictures of all pages of a case's report, `width_px` wide; runs on a thread. @throws InputError if there is
  /// none.
  using Renderer = std::function<std::vector<QImage>(const Case&, const std::filesystem::path& case_dir, const Model&,
                                                     const std::filesystem::path& resource_dir, int width_px)>;
  ReportStagePage(Workspace& workspace, Renderer renderer);

  void exportPdf(const std::filesystem::path& file);

 protected:
  void refresh() override;

 private:
  void drawPages();
  void showPages(std::vector<QImage> images);

  Renderer renderer_;
  QPushButton* export_;
  QScrollArea* scroll_;
  QLabel* placeholder_;
  std::string drawn_;      ///< content of the report whose pages are shown, or being drawn
  JobRunner preview_job_;  ///< beside the stages: drawing pages must not block a run
};

}  // namespace sinew
