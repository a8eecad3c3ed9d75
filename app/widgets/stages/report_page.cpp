#include "app/widgets/stages/report_page.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "clinical/case/case_io.h"
#include "core/file.h"

namespace sinew {
namespace {

constexpr int kPageWidth = 820;  // logical pixels: an A4 page that can be read

}  // namespace

ReportStagePage::ReportStagePage(Workspace& workspace, Renderer renderer)
    : StagePage{workspace, Stage::Report, tr("One page and annexes, as they will be printed.")},
      renderer_{std::move(renderer)} {
  export_ = makeButton("export_report", tr("Export PDF …"), "export", tr("Write the report to a PDF file (Ctrl+E)"));
  export_->setShortcut(QKeySequence{"Ctrl+E"});
  actions().addWidget(export_);
  connect(export_, &QPushButton::clicked, this, [this] {
    const auto file = askForNewFile(this, tr("Export report"), "report.pdf", tr("PDF (*.pdf)"));
    if (!file.empty()) exportPdf(file);
  });
  scroll_ = new QScrollArea;
  scroll_->setObjectName("report_scroll");
  scroll_->setWidgetResizable(true);
  placeholder_ = makeLabel({}, "muted");
  placeholder_->setObjectName("report_placeholder");
  placeholder_->setAlignment(Qt::AlignCenter);
  placeholder_->setWordWrap(true);
  body().addWidget(scroll_, 1);
  body().addWidget(placeholder_, 1);
  connect(&preview_job_, &JobRunner::released, this, [this] {
    if (isVisible() && this->workspace().document().isOpen()) refresh();
  });
  connect(&preview_job_, &JobRunner::ended, this, [this](JobRunner::Ending, const QString& message) {
    if (message.isEmpty()) return;
    drawn_ = shownCase().report ? shownCase().report->sha256 : std::string{};  // not again until the report changes
    emit this->workspace().problem(message);
  });
}

void ReportStagePage::refresh() {
  const bool fresh = workspace().document().stateOf(Stage::Report) == StageState::Done && shownCase().report;
  export_->setEnabled(fresh);
  const bool shown = fresh && drawn_ == shownCase().report->sha256 && !preview_job_.isBusy();
  scroll_->setVisible(shown);
  placeholder_->setVisible(!shown);
  if (shown) return;
  if (fresh) {
    placeholder_->setText(tr("Drawing the pages …"));
    drawPages();
    return;
  }
  QStringList reasons;
  for (const auto& reason : reasonsAgainstReport(shownCase(), workspace().resourceDir()))
    reasons << "•  " + QString::fromStdString(reason);
  placeholder_->setText(reasons.isEmpty()
                            ? tr("Everything is there: run this stage to make the report.")
                            : tr("A report is only made from fresh results:\n\n%1").arg(reasons.join('\n')));
}

void ReportStagePage::drawPages() {
  const int width_px = int(kPageWidth * devicePixelRatioF());
  const auto folder = workspace().document().folder();
  Workspace& shared = workspace();
  const bool started =
      preview_job_.start(tr("Draw the report"),
                         [=, this, c = shownCase(), &shared, render = renderer_](const Job&) -> JobRunner::Finish {
                           auto images = render(c, folder, *shared.reference(), shared.resourceDir(), width_px);
                           return [this, c, images = std::move(images)] {
                             drawn_ = c.report->sha256;
                             showPages(images);
                           };
                         });
  if (started) drawn_.clear();
}

void ReportStagePage::showPages(std::vector<QImage> images) {
  auto* column = new QVBoxLayout;
  column->setContentsMargins(0, 4, 0, 4);
  column->setSpacing(16);
  auto* pages = new QWidget;
  pages->setLayout(column);
  int number = 0;
  for (QImage& image : images) {
    image.setDevicePixelRatio(devicePixelRatioF());
    auto* page = new QLabel;
    page->setObjectName(QString{"report_page_%1"}.arg(++number));
    page->setAccessibleName(tr("Page %1 of the report").arg(number));
    page->setPixmap(QPixmap::fromImage(image));
    page->setStyleSheet("background: white; border: 1px solid " + colour::kBorder.name());
    column->addWidget(page, 0, Qt::AlignHCenter);
  }
  column->addStretch();
  scroll_->setWidget(pages);  // deletes the old one
}

void ReportStagePage::exportPdf(const std::filesystem::path& file) {
  try {
    if (!shownCase().report) throw InputError{"The report has not been made yet."};
    writeFileAtomically(file, readFile(checkedFile(*shownCase().report, workspace().document().folder())));
    emit workspace().notice(tr("Report written to %1").arg(QString::fromStdString(file.filename().string())));
  } catch (const InputError& error) {
    emit workspace().problem(QString::fromUtf8(error.what()));
  }
}

}  // namespace sinew
