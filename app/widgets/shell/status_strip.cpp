#include "app/widgets/shell/status_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <algorithm>

#include "app/model/workspace.h"
#include "app/widgets/controls/theme.h"
#include "core/version.h"

namespace sinew {

StatusStrip::StatusStrip(Workspace& workspace, QWidget* parent) : QWidget{parent}, workspace_{workspace} {
  setObjectName("status_strip");
  setAttribute(Qt::WA_StyledBackground);
  setFixedHeight(36);
  text_ = makeLabel({}, "small");
  text_->setObjectName("status_text");
  bar_ = new QProgressBar;
  bar_->setObjectName("progress");
  bar_->setRange(0, 1000);
  bar_->setTextVisible(false);
  bar_->setFixedWidth(220);
  bar_->setAccessibleName(tr("Progress"));
  cancel_ = new QPushButton{tr("Cancel")};
  cancel_->setObjectName("cancel_job");
  cancel_->setProperty("role", "danger");
  cancel_->setToolTip(tr("Stop the computation (Esc)"));
  cancel_->setStyleSheet("min-height: 22px;");
  note_ = makeLabel(QString{"Sinew %1 · %2"}.arg(kVersion, kDisclaimer), "small");
  auto* row = new QHBoxLayout{this};
  row->setContentsMargins(18, 0, 18, 0);
  row->setSpacing(12);
  row->addWidget(text_);
  row->addWidget(bar_);
  row->addWidget(cancel_);
  row->addStretch();
  row->addWidget(note_);

  JobRunner& jobs = workspace_.jobs();
  connect(cancel_, &QPushButton::clicked, &jobs, &JobRunner::cancel);
  connect(&jobs, &JobRunner::started, this, [this](const QString& title) {
    text_->setText(title + " …");
    bar_->setValue(0);
    bar_->show();
    cancel_->setEnabled(true);
    cancel_->show();
  });
  connect(&jobs, &JobRunner::progressed, this, [this](double fraction, const QString& stage) {
    bar_->setValue(int(1000 * std::clamp(fraction, 0.0, 1.0)));
    if (!stage.isEmpty()) text_->setText(stage);
  });
  connect(&jobs, &JobRunner::cancelling, this, [this] {
    text_->setText(tr("Stopping …"));
    cancel_->setEnabled(false);
  });
  connect(&jobs, &JobRunner::ended, this, &StatusStrip::idle);
  idle();
}

void StatusStrip::idle() {
  bar_->hide();
  cancel_->hide();
  text_->setText(tr("Ready"));
}

}  // namespace sinew
