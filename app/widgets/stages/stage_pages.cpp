#include "app/widgets/stages/stage_pages.h"

#include <QLabel>
#include <QVBoxLayout>

#include "app/model/stage_text.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/stages/calibration_page.h"
#include "app/widgets/stages/exam_page.h"
#include "app/widgets/stages/images_page.h"
#include "app/widgets/stages/landmarks_page.h"
#include "app/widgets/stages/musculature_page.h"
#include "app/widgets/stages/skeleton_page.h"

namespace sinew {
namespace {

/// Title, run button and warnings of the frame, and the key figures of the last run.
class PlainStagePage : public StagePage {
 public:
  PlainStagePage(Workspace& workspace, Stage stage) : StagePage{workspace, stage, {}} {
    summary_ = makeLabel({}, "muted");
    body().addWidget(summary_);
    body().addStretch(1);
  }

 private:
  void refresh() override {
    const auto record = shownCase().stages.find(stage());
    summary_->setText(record == shownCase().stages.end() ? stageLine(shownCase(), stage())
                                                         : QString::fromStdString(record->second.summary));
  }
  QLabel* summary_;
};

StagePage* makeStagePage(Workspace& workspace, Stage stage, ReportStagePage::Renderer& render_report) {
  switch (stage) {
    case Stage::Images:
      return new ImagesPage{workspace};
    case Stage::Calibration:
      return new CalibrationPage{workspace};
    case Stage::Landmarks:
      return new LandmarksPage{workspace};
    case Stage::Skeleton:
      return new SkeletonPage{workspace};
    case Stage::Musculature:
      return new MusculaturePage{workspace};
    case Stage::Exam:
      return new ExamPage{workspace};
    case Stage::Report:
      return new ReportStagePage{workspace, std::move(render_report)};
    default:
      return new PlainStagePage{workspace, stage};
  }
}

}  // namespace

std::map<Stage, StagePage*> makeStagePages(Workspace& workspace, ReportStagePage::Renderer render_report) {
  std::map<Stage, StagePage*> pages;
  for (const Stage stage : kStages) pages[stage] = makeStagePage(workspace, stage, render_report);
  return pages;
}

}  // namespace sinew
