#include "app/widgets/shell/welcome_page.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/model/workspace.h"
#include "app/widgets/controls/theme.h"

namespace sinew {

WelcomePage::WelcomePage(Workspace& workspace, QWidget* parent) : QWidget{parent} {
  setObjectName("welcome_page");
  setProperty("role", "page");
  setAttribute(Qt::WA_StyledBackground);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(32, 24, 32, 24);
  column->addStretch(3);
  auto* title = makeLabel(tr("A musculoskeletal model of this patient"), "display");
  title->setAlignment(Qt::AlignCenter);
  auto* text = makeLabel(tr("From two calibrated radiographs and a physical examination:\n"
                            "bones, muscles and joint ranges, a report for the surgeon, a model for simulation."),
                         "muted");
  text->setAlignment(Qt::AlignCenter);
  column->addWidget(title);
  column->addSpacing(8);
  column->addWidget(text);
  column->addSpacing(32);
  auto* row = new QHBoxLayout;
  row->setSpacing(12);
  auto* open = makeChoice("welcome_open", "folder-open", tr("Open a case"), tr("Continue with a case folder."));
  auto* fresh = makeChoice("welcome_new", "new-case", tr("New from images"),
                           tr("Begin with a frontal and a lateral radiograph."));
  auto* demo = makeChoice("welcome_demo", "demo", tr("Open demo patient"),
                          tr("A synthetic patient with known truth, made in a folder of your choice."));
  auto* explore = makeChoice("welcome_explorer", "explorer", tr("Explore the model"),
                             tr("The reference model: bones, muscles, joints and their ranges. Needs no case."));
  auto* retarget =
      makeChoice("welcome_retarget", "retarget", tr("Shape a body"),
                 tr("Change bones and ranges of motion; the muscles keep their function. Needs no case."));
  row->addStretch();
  for (auto* choice : {open, fresh, demo, explore, retarget}) row->addWidget(choice);
  row->addStretch();
  column->addLayout(row);
  column->addStretch(4);
  connect(open, &QPushButton::clicked, this, &WelcomePage::openWanted);
  connect(fresh, &QPushButton::clicked, this, &WelcomePage::newWanted);
  connect(demo, &QPushButton::clicked, this, &WelcomePage::demoWanted);
  connect(explore, &QPushButton::clicked, this, &WelcomePage::explorerWanted);
  connect(retarget, &QPushButton::clicked, this, &WelcomePage::retargetingWanted);
  const auto enable = [this, &workspace] { setEnabled(!workspace.jobs().isBusy()); };
  connect(&workspace.jobs(), &JobRunner::started, this, enable);
  connect(&workspace.jobs(), &JobRunner::released, this, enable);
}

QPushButton* WelcomePage::makeChoice(const QString& object_name, const QString& icon_name, const QString& title,
                                     const QString& text) {
  auto* button = new QPushButton;
  button->setObjectName(object_name);
  button->setAccessibleName(title);
  button->setFixedSize(184, 184);
  button->setCursor(Qt::PointingHandCursor);
  button->setStyleSheet("border-radius: 10px;");
  auto* column = new QVBoxLayout{button};
  column->setContentsMargins(16, 18, 16, 12);
  column->setSpacing(8);
  auto* picture = new QLabel;
  picture->setPixmap(icon(icon_name, colour::kPrimary).pixmap(34, 34));
  auto* words = makeLabel(text, "small");
  words->setWordWrap(true);
  column->addWidget(picture);
  column->addStretch();
  column->addWidget(makeLabel(title, "heading"));
  column->addWidget(words);
  words->setMinimumHeight(62);
  words->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  for (auto* label : button->findChildren<QLabel*>()) label->setAttribute(Qt::WA_TransparentForMouseEvents);
  return button;
}

}  // namespace sinew
