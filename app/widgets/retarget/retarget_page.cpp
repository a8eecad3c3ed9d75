#include "app/widgets/retarget/retarget_page.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QShortcut>
#include <QSplitter>
#include <QStackedWidget>
#include <QTabWidget>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/model/retarget/shape_form.h"
#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/retarget/body_view.h"
#include "app/widgets/retarget/characters_view.h"
#include "app/widgets/retarget/design_menus.h"
#include "app/widgets/retarget/factor_panel.h"
#include "app/widgets/retarget/rom_edit_panel.h"
#include "app/widgets/retarget/rom_edit_view.h"
#include "app/widgets/retarget/shape_panel.h"
#include "app/widgets/retarget/solver_state.h"
#include "clinical/case/patient_body.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

constexpr int kSettle_ms = 180;         // typing and keys: the muscles follow when the hand rests
constexpr int kShape = 0, kRanges = 2;  // tabs

double massOf_kg(const Model& model) {
  double mass_kg = 0;
  for (const auto& segment : model.skeleton.segments) mass_kg += segment.mass_kg;
  return mass_kg;
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
  body_view_ = new BodyView{solver_};
  right_->addWidget(body_view_);
  right_->addWidget(rom_view_);
  auto* splitter = new QSplitter;
  splitter->setChildrenCollapsible(false);
  splitter->setHandleWidth(12);
  auto* left_column = new QWidget;
  auto* left_rows = new QVBoxLayout{left_column};
  left_rows->setContentsMargins(0, 0, 0, 0);
  left_rows->setSpacing(8);
  left_rows->addWidget(left_, 1);
  left_rows->addWidget(new SolverState{solver_});
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

  settle_ = new QTimer{this};
  settle_->setSingleShot(true);
  settle_->setInterval(kSettle_ms);
  connect(settle_, &QTimer::timeout, this, [this] { solver_.solve(document_.current()); });
  connect(left_, &QTabWidget::currentChanged, this, &RetargetPage::showMode);
  connect(characters_button_, &QToolButton::toggled, this, &RetargetPage::showMode);
  connect(&document_, &DesignDocument::changed, this, &RetargetPage::designChanged);
  connect(&document_, &DesignDocument::previewed, this, [this] {
    settle_->stop();
    body_view_->designChanged(document_.isPreview());
    solver_.preview(document_.current());
    if (!document_.isPreview()) settle_->start();
  });
  connect(&document_, &DesignDocument::rejected, &workspace_, &Workspace::problem);
  connect(&solver_, &BodySolver::referenceLoaded, this, [this] {
    factors_->setMusculature(solver_.reference()->model().musculature);
    rom_view_->setReference(solver_.reference());
    solver_.solve(document_.current());
    if (characters_button_->isChecked()) characters_->open(solver_.reference(), workspace_.resourceDir());
  });
  connect(&solver_, &BodySolver::bodyChanged, this, &RetargetPage::showBody);
  connect(rom_view_, &RomEditView::muscleChosen, body_view_, &BodyView::setMuscle);
  connect(characters_, &CharactersView::problem, &workspace_, &Workspace::problem);
  connect(characters_, &CharactersView::notice, &workspace_, &Workspace::notice);
  connect(rom_panel_, &RomEditPanel::problem, &workspace_, &Workspace::problem);
  connect(rom_panel_, &RomEditPanel::notice, &workspace_, &Workspace::notice);
  connect(&workspace_.document(), &CaseDocument::replaced, this, [this] {
    if (taken_) {  // nothing of one patient is seen under the name of another, not by undo either
      taken_.reset();
      document_.reset({});
    }
  });
  for (const auto signal : {&CaseDocument::changed, &CaseDocument::replaced})
    connect(&workspace_.document(), signal, this, [this] {
      if (!isVisible()) return;
      followPatient();
      body_name_->setText(bodyInWords());
    });
  auto* find = new QShortcut{QKeySequence::Find, this};
  find->setContext(Qt::WidgetWithChildrenShortcut);
  connect(find, &QShortcut::activated, this, [this] {
    characters_button_->setChecked(false);
    if (left_->currentIndex() == kRanges) left_->setCurrentIndex(kShape);
    body_view_->focusSearch();
  });
}

QWidget* RetargetPage::makeHead() {
  menus_ = new DesignMenus{workspace_, document_, solver_, *this};
  connect(menus_, &DesignMenus::patientWanted, this, &RetargetPage::takePatient);
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
  for (QToolButton* button : {menus_->bodies(), characters_button_, menus_->files()}) row->addWidget(button);
  row->addWidget(close);
  connect(close, &QPushButton::clicked, this, &RetargetPage::closeWanted);
  return box;
}

void RetargetPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  followPatient();
  body_name_->setText(bodyInWords());
  solver_.load(loader_);
}

std::optional<RetargetDesign> RetargetPage::patientDesign() const {
  const Case& c = workspace_.document().current();
  if (workspace_.patientModelTitle().isEmpty()) return std::nullopt;
  RetargetDesign design;
  design.body.name = kPatientBody;
  design.body.shape = c.skeleton->shape;
  try {
    design.body.physics = patientPhysics(c.patient, c.exam, c.skeleton->shape, workspace_.reference()->skeleton);
  } catch (const InputError&) {
    return std::nullopt;  // a mass that cannot belong to these bones; the stages say so
  }
  return design;
}

void RetargetPage::takePatient() {
  taken_ = patientDesign();
  if (taken_) document_.edit(tr("Take this patient"), [&](RetargetDesign& d) { d.body = taken_->body; });
}

void RetargetPage::followPatient() {
  const auto patient = patientDesign();
  menus_->offerPatient(patient.has_value());
  const bool untouched = !document_.canUndo() && !document_.canRedo();
  const bool shows_taken = taken_ && document_.current() == *taken_;
  if (patient && untouched && (shows_taken || document_.current() == RetargetDesign{})) {
    taken_ = patient;
    document_.reset(*patient);
  } else if (patient && shows_taken && !(*patient == *taken_)) {
    takePatient();  // the bones were fitted anew
  } else if (!patient && shows_taken && untouched) {
    taken_.reset();
    document_.reset({});
  }
}

QString RetargetPage::bodyInWords() const {
  const RetargetDesign& design = document_.current();
  const QString words = shapeInWords(design.body.shape);
  const bool in_case = workspace_.document().isOpen();
  if (design.body.name == kPatientBody && in_case) {
    const auto patient = patientDesign();
    return patient && patient->body == design.body ? tr("This patient, before the examination")
                                                   : tr("This patient, changed: %1").arg(words);
  }
  const QString body = design.body.shape == ShapeParameters{}
                           ? tr("The reference body")
                           : QString::fromStdString(design.body.name) + ": " + words;
  return in_case ? tr("Not this patient: %1").arg(body) : body;
}

void RetargetPage::designChanged() {
  emit undoChanged();
  const RetargetDesign& design = document_.current();
  body_name_->setText(bodyInWords());
  body_view_->designChanged(false);
  solver_.preview(design);  // the bones at once; what was being solved is not wanted any more
  settle_->start();
}

void RetargetPage::showBody() {
  const auto& body = solver_.body();
  rom_panel_->setSkeleton(body->base);
  rom_view_->setBody(body, solver_.isCurrent());
  characters_->setPresent(body->model, body->design.body.shape == ShapeParameters{}
                                           ? tr("Present body")
                                           : readableName(body->design.body.name));
  factors_->showMass(massOf_kg(*body->model), massOf_kg(solver_.reference()->model()));
}

void RetargetPage::showMode() {
  all_->setCurrentIndex(characters_button_->isChecked() ? 1 : 0);
  right_->setCurrentIndex(left_->currentIndex() == kRanges ? 1 : 0);
  if (characters_button_->isChecked()) characters_->open(solver_.reference(), workspace_.resourceDir());
}

}  // namespace sinew
