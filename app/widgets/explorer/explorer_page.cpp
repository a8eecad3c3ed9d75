#include "app/widgets/explorer/explorer_page.h"

#include <QComboBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QShortcut>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTabWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <utility>

#include "app/model/explorer/muscle_text.h"
#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/colour_bar.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/explorer/joint_panel.h"
#include "app/widgets/explorer/muscle_card.h"
#include "app/widgets/explorer/muscle_curves.h"
#include "app/widgets/explorer/muscle_finder.h"
#include "app/widgets/explorer/rom_panel.h"
#include "app/widgets/views/model_view.h"

namespace sinew {
namespace {

constexpr int kFrame_ms = 15;  // a slider sends more changes than a screen can show

QTabWidget* makeTabs(const QString& object_name) {
  auto* tabs = new QTabWidget;
  tabs->setObjectName(object_name);
  tabs->setDocumentMode(true);
  return tabs;
}

}  // namespace

ExplorerPage::ExplorerPage(Workspace& workspace, RomStudy::Mapper mapper, QWidget* parent)
    : QWidget{parent}, workspace_{workspace}, explorer_{workspace.resourceDir()} {
  setObjectName("explorer_page");
  setProperty("role", "page");
  setAttribute(Qt::WA_StyledBackground);
  models_ = new QComboBox;
  models_->setObjectName("explorer_model");
  models_->setAccessibleName(tr("Model"));
  models_->setMinimumWidth(230);
  whose_ = new QLabel;
  whose_->setObjectName("explorer_whose");
  whose_->setProperty("badge", "stale");
  whose_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  auto* close = makeButton("explorer_close", tr("Close"), "close", tr("Leave the model explorer"));
  auto* head = new QHBoxLayout;
  head->setSpacing(10);
  head->addWidget(makeLabel(tr("Model explorer"), "title"));
  head->addSpacing(8);
  head->addWidget(models_);
  head->addWidget(whose_);
  head->addStretch(1);
  head->addWidget(close);

  finder_ = new MuscleFinder{explorer_};
  left_ = makeTabs("explorer_left");
  left_->addTab(finder_, tr("&Muscles"));
  left_->addTab(new JointPanel{explorer_}, tr("&Joints"));
  card_ = new MuscleCard{explorer_};
  curves_ = new MuscleCurves{explorer_};
  rom_ = new RomPanel{explorer_, std::move(mapper)};
  right_ = makeTabs("explorer_right");
  right_->addTab(card_, tr("C&ard"));
  right_->addTab(curves_, tr("C&urves"));
  right_->addTab(rom_, tr("&Range of motion"));
  auto* splitter = new QSplitter;
  splitter->setChildrenCollapsible(false);
  splitter->setHandleWidth(12);
  splitter->addWidget(left_);
  splitter->addWidget(makeView());
  splitter->addWidget(right_);
  left_->setMinimumWidth(282);
  right_->setMinimumWidth(318);
  splitter->setStretchFactor(0, 1);
  splitter->setStretchFactor(1, 4);
  splitter->setStretchFactor(2, 2);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(20, 14, 20, 14);
  column->setSpacing(12);
  column->addLayout(head);
  column->addWidget(splitter, 1);

  soon_ = new QTimer{this};
  soon_->setSingleShot(true);
  soon_->setInterval(kFrame_ms);
  connect(soon_, &QTimer::timeout, this, &ExplorerPage::refresh);
  connect(close, &QPushButton::clicked, this, &ExplorerPage::closeWanted);
  connect(models_, &QComboBox::activated, this, &ExplorerPage::chooseModel);
  connect(right_, &QTabWidget::currentChanged, this, &ExplorerPage::refreshWords);
  connect(view_, &ModelView::picked, this, [this](const std::string& name) {
    explorer_.setMuscle(name);  // a bone chooses none
  });
  connect(rom_, &RomPanel::mapOnBodyChanged, this, &ExplorerPage::showRom);
  connect(&explorer_, &Explorer::modelChanged, this, [this] {
    view_->setModel(explorer_.model(), zeroPosture(explorer_.model()->skeleton), {});
    fillModels();
  });
  for (const auto signal : {&Explorer::postureChanged, &Explorer::muscleChanged, &Explorer::coloursChanged})
    connect(&explorer_, signal, this, &ExplorerPage::refreshSoon);
  connect(&workspace_.document(), &CaseDocument::replaced, this, [this] { chosen_by_hand_ = false; });
  for (const auto signal : {&CaseDocument::changed, &CaseDocument::replaced})
    connect(&workspace_.document(), signal, this, [this] {
      if (isVisible()) followPatient();
      fillModels();
    });
  connect(&loading_.runner(), &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending == JobRunner::Ending::Failed) emit workspace_.problem(message);
    fillModels();
  });
  auto* find = new QShortcut{QKeySequence::Find, this};
  connect(find, &QShortcut::activated, this, [this] {
    left_->setCurrentIndex(0);
    finder_->focusSearch();
  });
  fillModels();
}

QWidget* ExplorerPage::makeView() {
  view_ = new ModelView{"explorer_view", true};
  view_->withoutAxes();
  view_->setModel(nullptr, {}, tr("Loading the model …"));
  auto* strip = new QWidget;
  strip->setProperty("role", "view_strip");
  strip->setAttribute(Qt::WA_StyledBackground);
  strip->setStyleSheet("QWidget[role=\"view_strip\"] { border-radius: 0; }");
  colouring_ = new QComboBox;
  colouring_->setObjectName("explorer_colouring");
  colouring_->setAccessibleName(tr("Muscle colours"));
  colouring_->addItems(
      {tr("Colour: group"), tr("Colour: activation"), tr("Colour: fibre length"), tr("Colour: passive force")});
  bar_ = new ColourBar{ColourBar::Ground::Dark};
  bar_->setObjectName("explorer_colour_bar");
  auto* tools = new QVBoxLayout{strip};
  tools->setContentsMargins(10, 6, 10, 4);
  tools->setSpacing(2);
  tools->addWidget(colouring_);
  tools->addWidget(bar_);
  validity_ = new QLabel;
  validity_->setObjectName("explorer_validity");
  validity_->setProperty("validity", "yes");
  validity_->setWordWrap(true);
  validity_->setMinimumHeight(44);
  validity_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  connect(colouring_, &QComboBox::activated, this,
          [this](int index) { explorer_.setColouring(MuscleColouring(index)); });
  auto* box = new QWidget;
  auto* column = new QVBoxLayout{box};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(view_, 1);
  column->addWidget(strip);
  column->addWidget(validity_);
  box->setMinimumWidth(330);
  return box;
}

void ExplorerPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  followPatient();
}

void ExplorerPage::fillModels() {
  const QSignalBlocker block{models_};
  models_->clear();
  const auto add = [this](const QString& title, Body body) {
    models_->addItem(title, QVariant::fromValue(int(body)));
  };
  const QString patient = workspace_.patientModelTitle();
  if (!patient.isEmpty()) add(patient, Body::Patient);
  add(tr("Reference model"), Body::Reference);
  add(tr("Reference model, athlete"), Body::Athlete);
  if (body_ == Body::File) models_->addItem(explorer_.title());
  add(tr("Open a model file …"), Body::File);
  const int shown = body_ == Body::File ? models_->findText(explorer_.title()) : models_->findData(int(body_));
  models_->setCurrentIndex(std::max(0, shown));
  whose_->setText(patient.isEmpty() ? tr("Not this patient, whose bones are not fitted yet")
                                    : tr("Not this patient"));
  whose_->setVisible(workspace_.document().isOpen() && body_ != Body::Patient && body_ != Body::None);
}

void ExplorerPage::chooseModel(int index) {
  const QVariant choice = models_->itemData(index);
  if (!choice.isValid()) return;  // what is shown already
  if (Body(choice.toInt()) == Body::File) {
    fillModels();  // the choice is no model: show the present one again
    const auto file = askForFile(this, tr("Model file"), tr("Sinew models (*.json)"));
    if (!file.empty()) openModelFile(file);
    return;
  }
  chosen_by_hand_ = true;
  show(Body(choice.toInt()));
}

void ExplorerPage::show(Body body) {
  if (body == Body::Patient) {
    showPatient();
  } else if (body == Body::Reference) {
    loadInBackground(body, tr("Reference model"), [this] { return workspace_.reference(); });
  } else {
    loadInBackground(body, tr("Reference model, athlete"), [this] {
      return std::make_shared<const Model>(loadReferenceModel(workspace_.resourceDir(), "athlete"));
    });
  }
}

void ExplorerPage::showPatient() {
  try {
    const auto model = workspace_.patientModel();
    if (!model) return;
    loading_.cancel();
    const bool was_patient = body_ == Body::Patient;
    body_ = Body::Patient;
    explorer_.setModel(model, workspace_.patientModelTitle());
    if (!was_patient) explorer_.setPosture(workspace_.document().current().skeleton->posture);
  } catch (const InputError& error) {
    emit workspace_.problem(QString::fromUtf8(error.what()));
  }
}

void ExplorerPage::followPatient() {
  const bool has_patient = !workspace_.patientModelTitle().isEmpty();
  if (has_patient && (body_ == Body::Patient || !chosen_by_hand_)) {
    try {
      if (body_ != Body::Patient || workspace_.patientModel() != explorer_.model()) showPatient();
    } catch (const InputError& error) {
      emit workspace_.problem(QString::fromUtf8(error.what()));
    }
  } else if (body_ == Body::Patient || (body_ == Body::None && !loading_.isBusy())) {
    body_ = Body::None;  // of another case, or of a state that was undone
    show(Body::Reference);
  }
}

void ExplorerPage::openModelFile(const std::filesystem::path& file) {
  // Patients: the name of a file may be a person's, and titles show; the model's own name is used.
  chosen_by_hand_ = true;
  loadInBackground(Body::File, tr("Model from a file"),
                   [this, file] { return std::make_shared<const Model>(loadModel(file, *workspace_.reference())); });
}

void ExplorerPage::loadInBackground(Body body, const QString& title,
                                    std::function<std::shared_ptr<const Model>()> load) {
  loading_.post(
      tr("Loading the model"),
      [this, body, title, load = std::move(load)](const Job&) -> JobRunner::Finish {
        auto model = load();
        return [this, body, title, model] {
          const Body before = std::exchange(body_, body);
          try {
            explorer_.setModel(model, title);
          } catch (const InputError& error) {
            body_ = before;
            emit workspace_.problem(QString::fromUtf8(error.what()));
          }
        };
      },
      true);
}

void ExplorerPage::refreshSoon() {
  if (!soon_->isActive()) soon_->start();
}

void ExplorerPage::refresh() {
  if (!explorer_.model()) return;
  view_->show(explorer_.posture(), explorer_.muscle(), showColours());
  const PostureEvaluation& e = explorer_.evaluation();
  validity_->setText(validityText(*explorer_.model(), e));
  setRole(validity_, "validity", e.valid ? "yes" : "no");
  refreshWords();
}

void ExplorerPage::refreshWords() {
  if (card_->isVisible()) card_->refresh();
  if (curves_->isVisible()) curves_->refresh();
}

std::optional<MuscleScalars> ExplorerPage::showColours() {
  colouring_->setCurrentIndex(int(explorer_.colouring()));
  const auto scale = explorer_.colourScale();
  if (!scale) {
    bar_->setWords(tr("One colour a muscle group: see the list"));
    return std::nullopt;
  }
  bar_->setScale(scale->title, scale->low, scale->high, scale->decimals, scale->open_ended && scale->diverging,
                 scale->open_ended, scale->diverging ? divergingColour : sequentialColour);
  MuscleScalars scalars;
  scalars.low = scale->low;
  scalars.high = scale->high;
  scalars.diverging = scale->diverging;
  const auto& units = explorer_.model()->musculature.units;
  for (std::size_t i = 0; i < units.size(); ++i) scalars.by_unit[units[i].name] = scale->by_unit[i];
  return scalars;
}

void ExplorerPage::showRom() {
  const RomMap* map = rom_->mapOnBody();
  view_->showRom(map ? std::optional{*map} : std::nullopt, rom_->widest_rad());
}

}  // namespace sinew
