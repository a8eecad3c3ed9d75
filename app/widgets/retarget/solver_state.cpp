#include "app/widgets/retarget/solver_state.h"

#include <QHBoxLayout>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/model/stage_text.h"
#include "app/widgets/controls/controls.h"
#include "core/retarget/retarget.h"

namespace sinew {

SolverState::SolverState(BodySolver& solver, QWidget* parent) : QFrame{parent}, solver_{solver} {
  setObjectName("solver_state");
  state_ = new ElidedLabel{""};
  state_->setObjectName("retarget_state");
  progress_ = new QProgressBar;
  progress_->setObjectName("retarget_progress");
  progress_->setAccessibleName(tr("Progress of retargeting"));
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  cancel_ = makeButton("retarget_cancel", tr("Cancel"), {}, tr("Stop retargeting; the naive muscles stay (Esc)"));
  QSizePolicy policy = progress_->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  progress_->setSizePolicy(policy);
  auto* words = new QVBoxLayout;
  words->setSpacing(4);
  words->addWidget(state_);
  words->addWidget(progress_);
  setProperty("role", "card");
  setFixedHeight(48);  // with the button and without
  auto* row = new QHBoxLayout{this};
  row->setContentsMargins(12, 6, 8, 6);
  row->setSpacing(8);
  row->addLayout(words, 1);
  row->addWidget(cancel_);
  connect(cancel_, &QPushButton::clicked, &solver_, &BodySolver::cancel);

  connect(&solver_, &BodySolver::stateChanged, this, &SolverState::refresh);
  connect(&solver_.runner(), &JobRunner::progressed, this, [this](double fraction, const QString& stage) {
    progress_->setValue(int(1000 * fraction));
    if (solver_.isSolving()) state_->setText(tr("Naive muscles; retargeting: %1").arg(stage));
  });
  refresh();
}

void SolverState::refresh() {
  const bool solving = solver_.isSolving();
  progress_->setVisible(solving);
  cancel_->setVisible(solving);
  if (!solving) progress_->setValue(0);
  if (!solver_.reference())
    state_->setText(solver_.problem().isEmpty() ? tr("Preparing the reference …") : solver_.problem());
  else if (!solver_.problem().isEmpty())
    state_->setText(tr("Not retargeted: %1").arg(solver_.problem()));
  else if (solver_.isCurrent())
    state_->setText(solver_.body()->rom_problem.isEmpty()
                        ? tr("Retargeted muscles, solved in %1 s").arg(figure(solver_.body()->solve_s, 2))
                        : tr("Retargeted; ranges not edited: %1").arg(solver_.body()->rom_problem));
  else if (solving)
    state_->setText(tr("Naive muscles; retargeting …"));
  else if (solver_.wasCancelled())
    state_->setText(tr("Cancelled: naive muscles are shown"));
  else
    state_->setText(tr("Naive muscles"));
}

}  // namespace sinew
