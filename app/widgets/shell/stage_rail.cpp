#include "app/widgets/shell/stage_rail.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

/// Sign and colour of a state on the dark rail; the sign differs in form, not in colour alone.
std::pair<const char*, QColor> signOf(StageState state) {
  switch (state) {
    case StageState::Done:
      return {"check", QColor{0x5f, 0xd3, 0x9a}};
    case StageState::Stale:
      return {"clock", QColor{0xff, 0xc4, 0x5c}};
    case StageState::Failed:
      return {"error", QColor{0xff, 0x8a, 0x80}};
    case StageState::Ready:
      return {"play", QColor{0x7c, 0xcb, 0xe6}};
    default:
      return {"", QColor{}};
  }
}

}  // namespace

StageRail::StageRail(Workspace& workspace, QWidget* parent) : QWidget{parent}, workspace_{workspace} {
  setObjectName("stage_rail");
  setAttribute(Qt::WA_StyledBackground);
  setFixedWidth(244);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(10, 14, 10, 14);
  column->setSpacing(4);
  auto* caption = makeLabel(tr("STAGES"), "caption");
  caption->setContentsMargins(10, 0, 0, 4);
  column->addWidget(caption);
  for (const Stage stage : kStages) {
    entries_.emplace(stage, makeEntry(stage));
    column->addWidget(entries_.at(stage).button);
  }
  column->addStretch();
  explorer_ = makePlace("open_explorer", "explorer", tr("Model explorer"),
                        tr("Bones, muscles, joints and their ranges; with or without a case (Ctrl+M)"),
                        [this] { workspace_.view().setExplorer(true); });
  retargeting_ = makePlace("open_retargeting", "retarget", tr("Retargeting"),
                           tr("Shape a body, its muscles keep their function; needs no case (Ctrl+T)"),
                           [this] { workspace_.view().setRetargeting(true); });
  column->addWidget(explorer_);
  column->addWidget(retargeting_);
  column->addSpacing(12);
  run_all_ = new QPushButton{icon("play-all", Qt::white), tr("Run all")};
  run_all_->setObjectName("run_all");
  run_all_->setProperty("role", "primary");
  run_all_->setToolTip(tr("Run every stage that is not done (Ctrl+Shift+R)"));
  connect(run_all_, &QPushButton::clicked, &workspace_, &Workspace::runAll);
  column->addWidget(run_all_);

  connect(&workspace_.document(), &CaseDocument::changed, this, &StageRail::refresh);
  connect(&workspace_.view(), &ViewState::stageChanged, this, &StageRail::refreshSelection);
  connect(&workspace_.jobs(), &JobRunner::started, this, &StageRail::refresh);
  connect(&workspace_.jobs(), &JobRunner::released, this, &StageRail::refresh);
  refresh();
  refreshSelection();
}

QPushButton* StageRail::makePlace(const QString& object_name, const QString& icon_name, const QString& title,
                                  const QString& tip, const std::function<void()>& open) {
  auto* button = new QPushButton;
  button->setObjectName(object_name);
  button->setProperty("role", "stage");
  button->setCheckable(true);
  button->setFixedHeight(40);
  button->setCursor(Qt::PointingHandCursor);
  button->setAccessibleName(title);
  button->setToolTip(tip);
  auto* picture = new QLabel;
  picture->setPixmap(icon(icon_name, QColor{0xc9, 0xd6, 0xe0}).pixmap(22, 22));
  auto* words = makeLabel(title, "heading");
  auto* row = new QHBoxLayout{button};
  row->setContentsMargins(12, 0, 10, 0);
  row->setSpacing(9);
  row->addWidget(picture);
  row->addWidget(words, 1);
  for (QLabel* child : {picture, words}) child->setAttribute(Qt::WA_TransparentForMouseEvents);
  connect(button, &QPushButton::clicked, this, [this, open] {
    open();
    refreshSelection();  // a second click must not uncheck it
  });
  return button;
}

StageRail::Entry StageRail::makeEntry(Stage stage) {
  const QString name = QString::fromStdString(nameOf(stage));
  Entry entry;
  entry.button = new QPushButton;
  entry.button->setObjectName("stage_" + name);
  entry.button->setProperty("role", "stage");
  entry.button->setCheckable(true);
  entry.button->setFixedHeight(56);
  entry.button->setCursor(Qt::PointingHandCursor);
  auto* picture = new QLabel;
  picture->setPixmap(icon(name, QColor{0xc9, 0xd6, 0xe0}).pixmap(22, 22));
  entry.title = makeLabel(QString::fromStdString(titleOf(stage)), "heading");
  entry.line = new ElidedLabel{"small"};
  entry.sign = new QLabel;
  entry.sign->setFixedSize(20, 20);
  auto* text = new QVBoxLayout;
  text->setSpacing(1);
  text->addStretch();
  text->addWidget(entry.title);
  text->addWidget(entry.line);
  text->addStretch();
  auto* row = new QHBoxLayout{entry.button};
  row->setContentsMargins(12, 0, 10, 0);
  row->setSpacing(9);
  row->addWidget(picture);
  row->addLayout(text, 1);
  row->addWidget(entry.sign);
  for (QWidget* child : {static_cast<QWidget*>(picture), static_cast<QWidget*>(entry.title),
                         static_cast<QWidget*>(entry.line), static_cast<QWidget*>(entry.sign)})
    child->setAttribute(Qt::WA_TransparentForMouseEvents);
  connect(entry.button, &QPushButton::clicked, this, [this, stage] {
    workspace_.view().setStage(stage);
    refreshSelection();  // a second click must not uncheck the current stage
  });
  return entry;
}

void StageRail::refresh() {
  const bool open = workspace_.document().isOpen();
  refreshSelection();
  bool anything_to_run = false;
  for (auto& [stage, entry] : entries_) {
    entry.button->setEnabled(open);
    if (!open) {
      entry.line->clear();
      entry.line->hide();  // the title stands in the middle
      entry.sign->clear();
      continue;
    }
    const StageState state = workspace_.document().stateOf(stage);
    anything_to_run |= state != StageState::Done;
    const QString line =
        state == StageState::Stale ? tr("Out of date") : stageLine(workspace_.document().current(), stage);
    entry.line->setText(line);
    entry.line->show();
    const auto [sign, color] = signOf(state);
    entry.sign->setPixmap(*sign ? icon(sign, color).pixmap(18, 18) : QPixmap{});
    const QString title = QString::fromStdString(titleOf(stage));
    entry.button->setAccessibleName(title + ", " + stateTitle(state));
    entry.button->setToolTip(title + " · " + stateTitle(state) + "\n" + line);
    entry.button->setProperty("state", QString::fromStdString(nameOf(state)));
  }
  run_all_->setEnabled(open && anything_to_run && !workspace_.jobs().isBusy());
}

void StageRail::refreshSelection() {
  for (auto& [stage, entry] : entries_)
    entry.button->setChecked(workspace_.document().isOpen() && !workspace_.view().explorer() &&
                             !workspace_.view().retargeting() && stage == workspace_.view().stage());
  explorer_->setChecked(workspace_.view().explorer());
  retargeting_->setChecked(workspace_.view().retargeting());
}

}  // namespace sinew
