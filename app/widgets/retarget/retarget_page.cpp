#include "app/widgets/retarget/retarget_page.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QShortcut>
#include <QSplitter>
#include <QStackedWidget>
#include <QTabWidget>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/model/retarget/design_files.h"
#include "app/model/retarget/shape_form.h"
#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/scene/lineup.h"
#include "app/widgets/controls.h"
#include "app/widgets/explorer/colour_bar.h"
#include "app/widgets/model_view.h"
#include "app/widgets/retarget/change_inspector.h"
#include "app/widgets/retarget/characters_view.h"
#include "app/widgets/retarget/factor_panel.h"
#include "app/widgets/retarget/family_curves.h"
#include "app/widgets/retarget/rom_edit_panel.h"
#include "app/widgets/retarget/rom_edit_view.h"
#include "app/widgets/retarget/shape_panel.h"
#include "app/widgets/theme.h"

namespace sinew {
namespace {

constexpr int kFrame_ms = 15;    // a slider sends more changes than a screen can show
constexpr int kSettle_ms = 180;  // typing and keys: the muscles follow when the hand rests
constexpr int kShape = 0, kFactors = 1, kRanges = 2;
constexpr double kLeastChange = -2, kMostChange = 2;  // ends of the colours: energy's decimal logarithm
enum Shown { kNewest, kNaive, kReference };

double massOf_kg(const Model& model) {
  double mass_kg = 0;
  for (const auto& segment : model.skeleton.segments) mass_kg += segment.mass_kg;
  return mass_kg;
}

QToolButton* makeMenuButton(const QString& object_name, const QString& text, const QString& icon_name,
                            const QString& tip, QMenu* menu) {
  auto* button = new QToolButton;
  button->setObjectName(object_name);
  button->setText(text);
  button->setIcon(icon(icon_name));
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setProperty("words", true);
  button->setProperty("menu", true);
  button->setPopupMode(QToolButton::InstantPopup);
  button->setMenu(menu);
  menu->setObjectName(object_name + "_menu");
  menu->setToolTipsVisible(true);
  return button;
}

}  // namespace

RetargetPage::RetargetPage(Workspace& workspace, BodySolver::Loader loader, QWidget* parent)
    : QWidget{parent}, workspace_{workspace}, loader_{std::move(loader)} {
  setObjectName("retarget_page");
  setProperty("role", "page");
  setAttribute(Qt::WA_StyledBackground);
  if (!loader_) loader_ = [this] { return loadRetargetReference(workspace_.resourceDir()); };
  auto* head = makeHead();
  shape_ = new ShapePanel{document_};
  factors_ = new FactorPanel{document_};
  rom_panel_ = new RomEditPanel{document_};
  rom_view_ = new RomEditView{document_, *rom_panel_};
  left_ = new QTabWidget;
  left_->setObjectName("retarget_left");
  left_->setDocumentMode(true);
  left_->addTab(shape_, tr("&Shape"));
  left_->addTab(factors_, tr("Mass, &force"));
  left_->addTab(rom_panel_, tr("&Ranges"));
  right_ = new QStackedWidget;
  right_->addWidget(makeBodyView());
  right_->addWidget(rom_view_);
  auto* splitter = new QSplitter;
  splitter->setChildrenCollapsible(false);
  splitter->setHandleWidth(12);
  auto* left_column = new QWidget;
  auto* left_rows = new QVBoxLayout{left_column};
  left_rows->setContentsMargins(0, 0, 0, 0);
  left_rows->setSpacing(8);
  left_rows->addWidget(left_, 1);
  left_rows->addWidget(makeState());
  left_column->setMinimumWidth(306);
  splitter->addWidget(left_column);
  splitter->addWidget(right_);
  splitter->setStretchFactor(0, 0);
  splitter->setStretchFactor(1, 1);
  splitter->setSizes({306, 680});
  characters_ = new CharactersView;
  all_ = new QStackedWidget;
  all_->addWidget(splitter);
  all_->addWidget(characters_);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(20, 12, 20, 12);
  column->setSpacing(10);
  column->addWidget(head);
  column->addWidget(all_, 1);

  soon_ = new QTimer{this};
  soon_->setSingleShot(true);
  soon_->setInterval(kFrame_ms);
  settle_ = new QTimer{this};
  settle_->setSingleShot(true);
  settle_->setInterval(kSettle_ms);
  connect(soon_, &QTimer::timeout, this, &RetargetPage::refresh);
  connect(settle_, &QTimer::timeout, this, [this] { solver_.solve(document_.current()); });
  connect(left_, &QTabWidget::currentChanged, this, &RetargetPage::showMode);
  connect(characters_button_, &QToolButton::toggled, this, &RetargetPage::showMode);
  connect(&document_, &DesignDocument::changed, this, &RetargetPage::designChanged);
  connect(&document_, &DesignDocument::previewed, this, [this] {
    settle_->stop();
    if (document_.isPreview())
      solver_.preview(document_.current());
    else
      settle_->start();
  });
  connect(&document_, &DesignDocument::rejected, &workspace_, &Workspace::problem);
  connect(&solver_, &BodySolver::referenceLoaded, this, [this] {
    factors_->setMusculature(solver_.reference()->model().musculature);
    rom_view_->setReference(solver_.reference());
    solver_.solve(document_.current());
    if (characters_button_->isChecked()) characters_->open(solver_.reference(), workspace_.resourceDir());
  });
  for (const auto signal : {&BodySolver::naiveChanged, &BodySolver::bodyChanged})
    connect(&solver_, signal, this, &RetargetPage::refreshSoon);
  connect(&solver_, &BodySolver::bodyChanged, this, &RetargetPage::showBody);
  connect(&solver_, &BodySolver::stateChanged, this, &RetargetPage::refreshState);
  connect(&solver_.runner(), &JobRunner::progressed, this, [this](double fraction, const QString& stage) {
    progress_->setValue(int(1000 * fraction));
    if (solver_.isSolving()) state_->setText(tr("Naive muscles; retargeting: %1").arg(stage));
  });
  connect(inspector_, &ChangeInspector::chosen, this, &RetargetPage::setMuscle);
  connect(rom_view_, &RomEditView::muscleChosen, this, &RetargetPage::setMuscle);
  connect(view_, &ModelView::picked, this, [this](const std::string& name) {
    if (const auto model = shownModel();
        model && std::ranges::count(model->musculature.units, name, &MusculotendonUnit::name))
      setMuscle(name);
  });
  connect(characters_, &CharactersView::problem, &workspace_, &Workspace::problem);
  connect(characters_, &CharactersView::notice, &workspace_, &Workspace::notice);
  connect(rom_panel_, &RomEditPanel::problem, &workspace_, &Workspace::problem);
  connect(rom_panel_, &RomEditPanel::notice, &workspace_, &Workspace::notice);
  auto* find = new QShortcut{QKeySequence::Find, this};
  find->setContext(Qt::WidgetWithChildrenShortcut);
  connect(find, &QShortcut::activated, this, [this] {
    characters_button_->setChecked(false);
    if (left_->currentIndex() == kRanges) left_->setCurrentIndex(kShape);
    inspector_->focusSearch();
  });
  refreshState();
}

QWidget* RetargetPage::makeHead() {
  auto* presets = new QMenu{this};
  for (const auto& name : shapePresetNames()) {
    auto* action = presets->addAction(readableName(name), this, [this, name] { takePreset(name); });
    action->setObjectName("preset_" + QString::fromStdString(name));
  }
  presets->addSeparator();
  presets->addAction(tr("From a file …"), this, &RetargetPage::openBodyFile)->setObjectName("preset_file");
  auto* files = new QMenu{this};
  const auto file = [&](const char* object_name, const QString& text, const QString& tip, auto call) {
    auto* action = files->addAction(text, this, call);
    action->setObjectName(object_name);
    action->setToolTip(tip);
  };
  file("save_body", tr("Save body …"), tr("Shape, masses and strengths, as JSON"), &RetargetPage::saveBodyFile);
  file("save_model", tr("Save model …"), tr("The retargeted model with edited ranges, as JSON"),
       &RetargetPage::saveModelFile);
  file("export_model", tr("Export model …"), tr("For other programs"), &RetargetPage::exportFile);
  auto* choose =
      makeMenuButton("preset_button", tr("Body"), "patient", tr("Take a body: a preset, or a file"), presets);
  auto* save = makeMenuButton("files_button", tr("Save, export"), "save",
                              tr("Save the body or the model, or export it"), files);
  characters_button_ = new QToolButton;
  characters_button_->setObjectName("characters_button");
  characters_button_->setText(tr("Characters"));
  characters_button_->setToolTip(tr("Reference, hulk, dwarf and alien side by side"));
  characters_button_->setAccessibleName(characters_button_->toolTip());
  characters_button_->setCheckable(true);
  characters_button_->setProperty("words", true);
  auto* close = makeButton("retarget_close", tr("Close"), "close", tr("Leave the retargeting workspace"));
  body_name_ = new ElidedLabel{"small"};
  body_name_->setObjectName("retarget_body");
  auto* box = new QWidget;
  auto* row = new QHBoxLayout{box};
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8);
  row->addWidget(makeLabel(tr("Retargeting"), "title"));
  row->addSpacing(4);
  row->addWidget(body_name_, 1);
  for (QToolButton* button : {choose, characters_button_, save}) row->addWidget(button);
  row->addWidget(close);
  connect(close, &QPushButton::clicked, this, &RetargetPage::closeWanted);
  return box;
}

QWidget* RetargetPage::makeBodyView() {
  curves_ = new FamilyCurves;
  inspector_ = new ChangeInspector;
  auto* curve_frame = new QFrame;
  curve_frame->setProperty("role", "card");
  auto* inside = new QVBoxLayout{curve_frame};
  inside->setContentsMargins(1, 1, 1, 1);
  inside->addWidget(curves_);
  auto* top = new QSplitter;
  top->setChildrenCollapsible(false);
  top->setHandleWidth(10);
  top->addWidget(makeView());
  top->addWidget(curve_frame);
  curve_frame->setMinimumWidth(290);
  top->setStretchFactor(0, 3);
  top->setStretchFactor(1, 2);
  top->setSizes({380, 300});
  auto* both = new QSplitter{Qt::Vertical};
  both->setObjectName("retarget_rows");
  both->setChildrenCollapsible(false);
  both->setHandleWidth(10);
  both->addWidget(top);
  both->addWidget(inspector_);
  both->setStretchFactor(0, 3);
  both->setStretchFactor(1, 1);
  both->setSizes({410, 190});
  inspector_->setMinimumHeight(120);
  return both;
}

QWidget* RetargetPage::makeView() {
  view_ = new ModelView{"retarget_view", true};
  view_->withoutAxes();
  view_->setModel(nullptr, {}, tr("Preparing the reference …"));
  shown_ = new QComboBox;
  shown_->setObjectName("retarget_shown");
  shown_->setAccessibleName(tr("Muscles shown"));
  shown_->setToolTip(
      tr("Which muscles are drawn: the newest there are, those moved with the bones, or the reference"));
  shown_->addItems({tr("Retargeted"), tr("Naive"), tr("Reference")});
  colouring_ = new QComboBox;
  colouring_->setObjectName("retarget_colouring");
  colouring_->setAccessibleName(tr("Muscle colours"));
  colouring_->setToolTip(tr("Groups of muscles, or how far function changed (energy of routing)"));
  colouring_->addItems({tr("Colour: group"), tr("Colour: change, naive"), tr("Colour: change, retargeted")});
  auto* strip = new QWidget;
  strip->setProperty("role", "view_strip");
  strip->setAttribute(Qt::WA_StyledBackground);
  strip->setStyleSheet(
      "QWidget[role=\"view_strip\"] { border-radius: 0; border-bottom-left-radius: 8px; border-bottom-right-radius: "
      "8px; }");
  auto* choices = new QHBoxLayout;
  choices->setSpacing(6);
  choices->addWidget(shown_, 2);
  choices->addWidget(colouring_, 3);
  auto* rows = new QVBoxLayout{strip};
  rows->setContentsMargins(10, 6, 10, 6);
  rows->setSpacing(4);
  rows->addLayout(choices);
  bar_ = new ColourBar{ColourBar::Ground::Dark};
  bar_->setScale(tr("Change of function, energy, power of ten"), kLeastChange, kMostChange, 0, true, true,
                 sequentialColour);
  bar_->hide();
  rows->addWidget(bar_);
  auto* box = new QWidget;
  auto* column = new QVBoxLayout{box};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(view_, 1);
  column->addWidget(strip);
  box->setMinimumWidth(300);
  connect(shown_, &QComboBox::currentIndexChanged, this, &RetargetPage::refreshSoon);
  connect(colouring_, &QComboBox::currentIndexChanged, this, &RetargetPage::refreshSoon);
  return box;
}

QWidget* RetargetPage::makeState() {
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
  auto* box = new QFrame;
  box->setProperty("role", "card");
  box->setFixedHeight(48);  // with the button and without
  auto* row = new QHBoxLayout{box};
  row->setContentsMargins(12, 6, 8, 6);
  row->setSpacing(8);
  row->addLayout(words, 1);
  row->addWidget(cancel_);
  connect(cancel_, &QPushButton::clicked, &solver_, &BodySolver::cancel);
  return box;
}

void RetargetPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  solver_.load(loader_);
}

void RetargetPage::designChanged() {
  emit undoChanged();
  const RetargetDesign& design = document_.current();
  const QString words = shapeInWords(design.body.shape);
  body_name_->setText(design.body.shape == ShapeParameters{}
                          ? tr("The reference body")
                          : QString::fromStdString(design.body.name) + ": " + words);
  fit_wanted_ = true;
  solver_.preview(design);  // the bones at once; what was being solved is not wanted any more
  settle_->start();
  refreshSoon();
}

void RetargetPage::refreshSoon() {
  if (!soon_->isActive()) soon_->start();
}

std::shared_ptr<const Model> RetargetPage::shownModel() const {
  if (!solver_.reference()) return nullptr;
  if (shown_->currentIndex() == kReference)
    return std::shared_ptr<const Model>{solver_.reference(), &solver_.reference()->model()};
  if (shown_->currentIndex() == kNewest && solver_.isCurrent()) return solver_.body()->model;
  return solver_.naive();
}

void RetargetPage::refresh() {
  const auto model = shownModel();
  if (!model) return;
  const bool other = model != drawn_;
  drawn_ = model;
  const Posture posture = standingOnGround(*model);
  if (other) view_->setModel(model, posture, {});
  std::optional<MuscleScalars> scalars;
  if (const auto& body = solver_.body(); body && colouring_->currentIndex() > 0) {
    scalars.emplace();
    scalars->low = kLeastChange;
    scalars->high = kMostChange;
    for (const MuscleChange& c : body->changes)
      scalars->by_unit[model->musculature.units[std::size_t(c.unit)].name] =
          std::log10(std::max(1e-9, colouring_->currentIndex() == 1 ? c.energy_naive : c.energy));
  }
  bar_->setVisible(scalars.has_value());
  view_->show(posture, muscle_, scalars);
  if (fit_wanted_ && !document_.isPreview()) view_->fit();
  if (solver_.isCurrent()) fit_wanted_ = false;
  curves_->show(solver_.reference(), solver_.naive(), solver_.isCurrent() ? solver_.body() : nullptr, muscle_);
}

void RetargetPage::showBody() {
  const auto& body = solver_.body();
  inspector_->setBody(body, solver_.isCurrent());
  inspector_->select(muscle_);
  rom_panel_->setSkeleton(body->base);
  rom_view_->setBody(body, solver_.isCurrent());
  characters_->setPresent(body->model, body->design.body.shape == ShapeParameters{}
                                           ? tr("Present body")
                                           : readableName(body->design.body.name));
  factors_->showMass(massOf_kg(*body->model), massOf_kg(solver_.reference()->model()));
}

void RetargetPage::refreshState() {
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
  if (solver_.body()) inspector_->setBody(solver_.body(), solver_.isCurrent());
}

void RetargetPage::showMode() {
  all_->setCurrentIndex(characters_button_->isChecked() ? 1 : 0);
  right_->setCurrentIndex(left_->currentIndex() == kRanges ? 1 : 0);
  if (characters_button_->isChecked()) characters_->open(solver_.reference(), workspace_.resourceDir());
}

void RetargetPage::setMuscle(const std::string& unit) {
  if (unit == muscle_) return;
  muscle_ = unit;
  inspector_->select(unit);
  refreshSoon();
}

void RetargetPage::report(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    emit workspace_.problem(QString::fromUtf8(error.what()));
  }
}

void RetargetPage::takePreset(const std::string& name) {
  report([&] {
    const BodyDescription body = loadShapePreset(workspace_.resourceDir(), name);
    document_.edit(tr("Take the %1").arg(QString::fromStdString(name)), [&](RetargetDesign& d) { d.body = body; });
  });
}

void RetargetPage::openBodyFile() {
  const auto file = askForFile(this, tr("Body"), tr("Bodies (*.json)"));
  if (file.empty()) return;
  report([&] {
    const BodyDescription body = loadBodyDescription(file);
    document_.edit(tr("Open a body"), [&](RetargetDesign& d) { d.body = body; });
  });
}

void RetargetPage::saveBodyFile() {
  const auto file = askForNewFile(this, tr("Body"), "body.json", tr("Bodies (*.json)"));
  if (file.empty()) return;
  report([&] {
    saveBodyDescription(document_.current().body, file);
    emit workspace_.notice(tr("Saved: %1").arg(QString::fromStdString(file.filename().string())));
  });
}

bool RetargetPage::isSolvedOr(const QString& wanted_for) {
  if (solver_.isCurrent()) return true;
  emit workspace_.problem(
      tr("%1: the muscles are not retargeted yet; wait, or undo the last change").arg(wanted_for));
  return false;
}

void RetargetPage::saveModelFile() {
  if (!isSolvedOr(tr("Save model"))) return;
  const auto file = askForNewFile(this, tr("Model"), "model.json", tr("Sinew models (*.json)"));
  if (file.empty()) return;
  report([&] {
    saveModel(*solver_.body()->model, file);
    emit workspace_.notice(tr("Saved: %1").arg(QString::fromStdString(file.filename().string())));
  });
}

void RetargetPage::exportFile() {
  if (!isSolvedOr(tr("Export model"))) return;
  const auto file = askForNewFile(this, tr("Export"), "model.xml", exportFilter());
  if (file.empty()) return;
  report([&] {
    exportModel(*solver_.body()->model, file);
    emit workspace_.notice(tr("Exported: %1").arg(QString::fromStdString(file.filename().string())));
  });
}

}  // namespace sinew
