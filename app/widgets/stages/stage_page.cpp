#include "app/widgets/stages/stage_page.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/theme.h"

namespace sinew {
namespace {

constexpr int kWarningsAtFirst = 1;

const char* badgeOf(StageState state) {
  switch (state) {
    case StageState::Done:
      return "done";
    case StageState::Ready:
      return "ready";
    case StageState::Stale:
      return "stale";
    case StageState::Failed:
      return "failed";
    default:
      return "quiet";
  }
}

}  // namespace

StagePage::StagePage(Workspace& workspace, Stage stage, const QString& purpose, QWidget* parent)
    : QWidget{parent}, workspace_{workspace}, stage_{stage} {
  const QString name = QString::fromStdString(nameOf(stage));
  setObjectName(name + "_page");
  setProperty("role", "page");
  setAttribute(Qt::WA_StyledBackground);

  auto* title = makeLabel(QString::fromStdString(titleOf(stage)), "title");
  badge_ = new QLabel;
  badge_->setObjectName(name + "_badge");
  badge_->setProperty("badge", "quiet");
  badge_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  explanation_ = makeLabel(purpose, "muted");
  explanation_->setObjectName(name + "_explanation");
  explanation_->setProperty("purpose", purpose);
  explanation_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  run_ = new QPushButton{icon("play", Qt::white), tr("Run stage")};
  run_->setObjectName("run_" + name);
  run_->setProperty("role", "primary");
  run_->setToolTip(tr("Compute this stage (Ctrl+R)"));
  connect(run_, &QPushButton::clicked, this, [this] { workspace_.runStage(stage_); });

  auto* head = new QHBoxLayout;
  head->setSpacing(10);
  head->addWidget(title);
  head->addWidget(badge_);
  head->addSpacing(4);
  head->addWidget(explanation_, 1);
  actions_ = new QHBoxLayout;
  actions_->setSpacing(8);
  head->addLayout(actions_);
  head->addWidget(run_);

  warning_frame_ = new QFrame;
  warning_frame_->setProperty("banner", "warning");
  auto* warning_line = new QHBoxLayout{warning_frame_};
  warning_line->setContentsMargins(10, 5, 6, 5);
  auto* sign = new QLabel;
  sign->setPixmap(icon("warning", colour::kWarning).pixmap(18, 18));
  warnings_ = new QLabel;
  warnings_->setObjectName(name + "_warnings");
  warnings_->setWordWrap(true);
  warnings_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  more_ = new QPushButton;
  more_->setProperty("role", "flat");
  more_->setObjectName(name + "_more_warnings");
  connect(more_, &QPushButton::clicked, this, [this] {
    all_warnings_ = !all_warnings_;
    refreshHead();
  });
  warning_line->addWidget(sign, 0, Qt::AlignTop);
  warning_line->addWidget(warnings_, 1);
  warning_line->addWidget(more_, 0, Qt::AlignTop);

  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(20, 14, 20, 14);
  column->setSpacing(12);
  column->addLayout(head);
  column->addWidget(warning_frame_);
  body_ = new QVBoxLayout;
  body_->setSpacing(12);
  column->addLayout(body_, 1);

  connect(&workspace_.document(), &CaseDocument::changed, this, &StagePage::update);
  connect(&workspace_.document(), &CaseDocument::previewed, this, [this] {
    if (isVisible()) refreshPreview();
  });
  for (const auto signal : {&JobRunner::released, &JobRunner::cancelling})
    connect(&workspace_.jobs(), signal, this, &StagePage::refreshHead);
  connect(&workspace_.jobs(), &JobRunner::started, this, &StagePage::refreshHead);
}

const Case& StagePage::shownCase() const {
  return workspace_.document().current();
}

void StagePage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (outdated_) update();
}

void StagePage::update() {
  outdated_ = true;
  if (!isVisible() || !workspace_.document().isOpen()) return;
  outdated_ = false;
  refreshHead();
  try {
    refresh();
  } catch (const InputError& error) {
    emit workspace_.problem(QString::fromUtf8(error.what()));
  }
}

void StagePage::refreshHead() {
  if (!workspace_.document().isOpen()) return;
  const StageState state = workspace_.document().stateOf(stage_);
  badge_->setText(stateTitle(state));
  setRole(badge_, "badge", badgeOf(state));
  const QString why = stateExplanation(state, stage_);
  explanation_->setText(why.isEmpty() ? explanation_->property("purpose").toString() : why);
  run_->setEnabled(!workspace_.jobs().isBusy() && state != StageState::Missing && state != StageState::Blocked);
  run_->setText(state == StageState::Done ? tr("Run again") : tr("Run stage"));

  const auto& records = shownCase().stages;
  const auto record = records.find(stage_);
  const Warnings warnings = record == records.end() ? Warnings{} : record->second.warnings;
  warning_frame_->setVisible(!warnings.empty());
  const std::size_t shown =
      all_warnings_ ? warnings.size() : std::min<std::size_t>(kWarningsAtFirst, warnings.size());
  QStringList lines;
  for (std::size_t i = 0; i < shown; ++i) lines << QString::fromStdString(warnings[i].message);
  warnings_->setText(lines.join('\n'));
  more_->setVisible(warnings.size() > std::size_t(kWarningsAtFirst));
  more_->setText(all_warnings_ ? tr("Show less") : tr("%1 more").arg(warnings.size() - kWarningsAtFirst));
}

}  // namespace sinew
