#include "app/widgets/shell/main_window.h"

#include <QAction>
#include <QCloseEvent>
#include <QHBoxLayout>
#include <QMessageBox>
#include <QPushButton>
#include <QShortcut>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/explorer/explorer_page.h"
#include "app/widgets/retarget/retarget_page.h"
#include "app/widgets/shell/banner.h"
#include "app/widgets/shell/new_case_dialog.h"
#include "app/widgets/shell/patient_dialog.h"
#include "app/widgets/shell/stage_rail.h"
#include "app/widgets/shell/status_strip.h"
#include "app/widgets/shell/welcome_page.h"
#include "app/widgets/stages/stage_pages.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {

MainWindow::MainWindow(Workspace& workspace, ReportStagePage::Renderer render_report) : workspace_{workspace} {
  setObjectName("main_window");
  setAttribute(Qt::WA_StyledBackground);
  setWindowTitle(
      "Sinew[*]");  // never a name of a patient or a folder: titles show up in task lists and screen shares
  setWindowIcon(icon("sinew", colour::kPrimary));
  setMinimumSize(1100, 700);
  actions_ = makeActions();

  pages_ = new QStackedWidget;
  pages_->setObjectName("pages");
  auto* welcome = new WelcomePage{workspace_};
  welcome_ = welcome;
  pages_->addWidget(welcome);
  stage_pages_ = makeStagePages(workspace_, std::move(render_report));
  for (const auto& [stage, page] : stage_pages_) pages_->addWidget(page);

  explorer_ = new ExplorerPage{workspace_};
  pages_->addWidget(explorer_);
  retarget_ = new RetargetPage{workspace_};
  pages_->addWidget(retarget_);

  banner_ = new Banner;
  auto* banner_line = new QHBoxLayout;
  banner_line->setContentsMargins(20, 0, 20, 0);
  banner_line->addWidget(banner_);
  auto* content = new QVBoxLayout;
  content->setSpacing(0);
  content->addLayout(banner_line);
  content->addWidget(pages_, 1);
  auto* middle = new QHBoxLayout;
  middle->setSpacing(0);
  middle->addWidget(new StageRail{workspace_});
  middle->addLayout(content, 1);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(new HeaderBar{workspace_, actions_});
  column->addLayout(middle, 1);
  column->addWidget(new StatusStrip{workspace_});

  connect(&workspace_, &Workspace::problem, banner_, &Banner::showProblem);
  connect(&workspace_, &Workspace::notice, banner_, &Banner::showNotice);
  connect(&workspace_.document(), &CaseDocument::changed, this, &MainWindow::refreshActions);
  connect(&workspace_.document(), &CaseDocument::saved, this, &MainWindow::refreshActions);
  connect(&workspace_.document(), &CaseDocument::replaced, this, [this] {
    banner_->hide();
    showStage();
  });
  connect(&workspace_.view(), &ViewState::stageChanged, this, &MainWindow::showStage);
  connect(welcome, &WelcomePage::openWanted, this, &MainWindow::openCase);
  connect(welcome, &WelcomePage::newWanted, this, &MainWindow::newCase);
  connect(welcome, &WelcomePage::demoWanted, this, &MainWindow::openDemo);
  connect(welcome, &WelcomePage::explorerWanted, this, [this] { workspace_.view().setExplorer(true); });
  connect(welcome, &WelcomePage::retargetingWanted, this, [this] { workspace_.view().setRetargeting(true); });
  connect(explorer_, &ExplorerPage::closeWanted, this, [this] { workspace_.view().setExplorer(false); });
  connect(retarget_, &RetargetPage::closeWanted, this, [this] { workspace_.view().setRetargeting(false); });
  connect(retarget_, &RetargetPage::undoChanged, this, &MainWindow::refreshActions);
  refreshActions();
  showStage();
}

HeaderBar::Actions MainWindow::makeActions() {
  const auto make = [this](const char* object_name, const char* icon_name, const QString& text,
                           const QKeySequence& keys) {
    auto* action = new QAction{icon(icon_name), text, this};
    action->setObjectName(object_name);
    action->setShortcut(keys);
    action->setToolTip(text + " (" + keys.toString(QKeySequence::NativeText) + ")");
    addAction(action);
    return action;
  };
  HeaderBar::Actions actions{make("action_new", "new-case", tr("New"), QKeySequence::New),
                             make("action_open", "folder-open", tr("Open"), QKeySequence::Open),
                             make("action_save", "save", tr("Save"), QKeySequence::Save),
                             make("action_undo", "undo", tr("Undo"), QKeySequence::Undo),
                             make("action_redo", "redo", tr("Redo"), QKeySequence{"Ctrl+Shift+Z"}),
                             make("action_patient", "patient", tr("Patient"), QKeySequence{"Ctrl+I"})};
  connect(actions.new_case, &QAction::triggered, this, &MainWindow::newCase);
  connect(actions.open, &QAction::triggered, this, &MainWindow::openCase);
  connect(actions.save, &QAction::triggered, this, &MainWindow::saveCase);
  connect(actions.patient, &QAction::triggered, this, &MainWindow::changePatient);
  // Undo belongs to what is looked at: the case, or the body that is being designed.
  connect(actions.undo, &QAction::triggered, this, [this] {
    if (workspace_.view().retargeting())
      retarget_->document().undo();
    else
      workspace_.document().undo();
  });
  connect(actions.redo, &QAction::triggered, this, [this] {
    if (workspace_.view().retargeting())
      retarget_->document().redo();
    else
      workspace_.document().redo();
  });
  const auto shortcut = [this](const char* keys, auto call) {
    connect(new QShortcut{QKeySequence{keys}, this}, &QShortcut::activated, this, call);
  };
  shortcut("Ctrl+R", [this] {
    if (auto* run = findChild<QPushButton*>("run_" + QString::fromStdString(nameOf(workspace_.view().stage()))))
      run->click();
  });
  shortcut("Ctrl+Shift+R", [this] { findChild<QPushButton*>("run_all")->click(); });
  shortcut("Ctrl+M", [this] { workspace_.view().setExplorer(true); });
  shortcut("Ctrl+T", [this] { workspace_.view().setRetargeting(true); });
  shortcut("Esc", [this] {
    workspace_.jobs().cancel();
    if (workspace_.view().retargeting()) retarget_->solver().cancel();
  });
  for (int i = 0; i < int(kStages.size()); ++i)
    shortcut(QString{"Alt+%1"}.arg(i + 1).toLatin1().constData(), [this, i] {
      if (workspace_.document().isOpen()) workspace_.view().setStage(kStages[std::size_t(i)]);
    });
  return actions;
}

void MainWindow::refreshActions() {
  const CaseDocument& document = workspace_.document();
  actions_.save->setEnabled(document.isModified());
  actions_.patient->setEnabled(document.isOpen());
  const auto offer = [&](const auto& history) {
    actions_.undo->setEnabled(history.canUndo());
    actions_.redo->setEnabled(history.canRedo());
    actions_.undo->setToolTip(history.canUndo() ? tr("Undo: %1 (Ctrl+Z)").arg(history.undoLabel())
                                                : tr("Nothing to undo"));
    actions_.redo->setToolTip(history.canRedo() ? tr("Redo: %1 (Ctrl+Shift+Z)").arg(history.redoLabel())
                                                : tr("Nothing to redo"));
  };
  if (workspace_.view().retargeting())
    offer(retarget_->document());
  else
    offer(document);
  setWindowModified(document.isModified());
}

void MainWindow::showStage() {
  QWidget* page = welcome_;
  if (workspace_.document().isOpen()) page = stage_pages_.at(workspace_.view().stage());
  if (workspace_.view().explorer()) page = explorer_;
  if (workspace_.view().retargeting()) page = retarget_;
  pages_->setCurrentWidget(page);
  refreshActions();
}

bool MainWindow::mayLeaveCase() {
  if (!workspace_.document().isModified()) return true;
  QMessageBox question{QMessageBox::NoIcon, tr("Unsaved changes"), tr("This case has changes that are not saved."),
                       QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this};
  question.setObjectName("unsaved_question");
  question.setDefaultButton(QMessageBox::Save);
  switch (question.exec()) {
    case QMessageBox::Save:
      saveCase();
      return !workspace_.document().isModified();
    case QMessageBox::Discard:
      return true;
    default:
      return false;
  }
}

void MainWindow::saveCase() {
  bool overwrite = false;
  if (workspace_.document().isOpen() && workspace_.document().wasChangedElsewhere()) {
    QMessageBox question{
        QMessageBox::NoIcon, tr("Changed elsewhere"),
        tr("Another program wrote into this case since it was opened. Saving replaces what it wrote."),
        QMessageBox::Save | QMessageBox::Cancel, this};
    question.setObjectName("changed_elsewhere_question");
    question.setDefaultButton(QMessageBox::Cancel);
    if (question.exec() != QMessageBox::Save) return;
    overwrite = true;
  }
  workspace_.saveCase(overwrite);
}

void MainWindow::newCase() {
  if (!mayLeaveCase()) return;
  NewCaseDialog dialog{this};
  if (dialog.exec() != QDialog::Accepted) return;
  try {
    const MadeCase made = makeCase(dialog.wanted(), dialog.folder(), dateToday());
    workspace_.document().adopt(made.c, dialog.folder());
    QStringList doubts;
    for (const auto& doubt : made.doubts) doubts << QString::fromStdString(doubt.message);
    if (!doubts.isEmpty()) emit workspace_.notice(doubts.join("; "));
  } catch (const InputError& error) {
    emit workspace_.problem(QString::fromUtf8(error.what()));
  }
}

void MainWindow::openCase() {
  if (!mayLeaveCase()) return;
  const auto folder = askForFolder(this, tr("Folder of the case"));
  if (!folder.empty()) workspace_.openCase(folder);
}

void MainWindow::changePatient() {
  if (!workspace_.document().isOpen()) return;
  PatientDialog{workspace_.document(), this}.exec();
}

void MainWindow::openDemo() {
  if (!mayLeaveCase()) return;
  const auto folder = askForFolder(this, tr("Empty folder for the demo patient"));
  if (!folder.empty()) workspace_.makeDemo(folder, false);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (mayLeaveCase())
    event->accept();
  else
    event->ignore();
}

}  // namespace sinew
