#include "app/widgets/report_page.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include "app/model/workspace.h"
#include "app/widgets/controls.h"
#include "app/widgets/theme.h"
#include "clinical/case_io.h"
#include "core/file.h"

namespace sinew {
namespace {

constexpr int kPageWidth = 820;  // logical pixels: an A4 page that can be read

}  // namespace

ReportPage::ReportPage(Workspace& workspace, Renderer renderer)
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
  pages_ = new QWidget;
  pages_->setLayout(new QVBoxLayout);
  scroll_->setWidget(pages_);
  placeholder_ = makeLabel({}, "muted");
  placeholder_->setObjectName("report_placeholder");
  placeholder_->setAlignment(Qt::AlignCenter);
  placeholder_->setWordWrap(true);
  body().addWidget(scroll_, 1);
  body().addWidget(placeholder_, 1);
}

void ReportPage::refresh() {
  const bool fresh = workspace().document().stateOf(Stage::Report) == StageState::Done && shownCase().report;
  export_->setEnabled(fresh);
  scroll_->setVisible(fresh);
  placeholder_->setVisible(!fresh);
  if (fresh) {
    showPages();
    return;
  }
  QStringList reasons;
  for (const auto& reason : reasonsAgainstReport(shownCase())) reasons << "•  " + QString::fromStdString(reason);
  placeholder_->setText(reasons.isEmpty()
                            ? tr("Everything is there: run this stage to make the report.")
                            : tr("A report is only made from fresh results:\n\n%1").arg(reasons.join('\n')));
}

void ReportPage::showPages() {
  auto* column = new QVBoxLayout;
  column->setContentsMargins(0, 4, 0, 4);
  column->setSpacing(16);
  auto* pages = new QWidget;
  pages->setLayout(column);
  const double ratio = devicePixelRatioF();
  int number = 0;
  for (QImage& image : renderer_(workspace(), int(kPageWidth * ratio))) {
    image.setDevicePixelRatio(ratio);
    auto* page = new QLabel;
    page->setObjectName(QString{"report_page_%1"}.arg(++number));
    page->setAccessibleName(tr("Page %1 of the report").arg(number));
    page->setPixmap(QPixmap::fromImage(image));
    page->setStyleSheet("background: white; border: 1px solid " + colour::kBorder.name());
    column->addWidget(page, 0, Qt::AlignHCenter);
  }
  column->addStretch();
  scroll_->setWidget(pages);  // deletes the old one
  pages_ = pages;
}

void ReportPage::exportPdf(const std::filesystem::path& file) {
  try {
    if (!shownCase().report) throw InputError{"The report has not been made yet."};
    writeFileAtomically(file, readFile(checkedFile(*shownCase().report, workspace().document().folder())));
    emit workspace().notice(tr("Report written to %1").arg(QString::fromStdString(file.filename().string())));
  } catch (const InputError& error) {
    emit workspace().problem(QString::fromUtf8(error.what()));
  }
}

}  // namespace sinew
