#include "app/widgets/retarget/body_view.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/scene/lineup.h"
#include "app/widgets/controls/colour_bar.h"
#include "app/widgets/retarget/change_inspector.h"
#include "app/widgets/retarget/family_curves.h"
#include "app/widgets/views/model_view.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

constexpr int kFrame_ms = 15;                         // a slider sends more changes than a screen can show
constexpr double kLeastChange = -2, kMostChange = 2;  // ends of the colours: energy's decimal logarithm
enum Shown { kNewest, kNaive, kReference };

}  // namespace

BodyView::BodyView(BodySolver& solver, QWidget* parent) : QSplitter{Qt::Vertical, parent}, solver_{solver} {
  setObjectName("body_view");
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
  setChildrenCollapsible(false);
  setHandleWidth(10);
  addWidget(top);
  addWidget(inspector_);
  setStretchFactor(0, 3);
  setStretchFactor(1, 1);
  setSizes({410, 190});
  inspector_->setMinimumHeight(120);

  soon_ = new QTimer{this};
  soon_->setSingleShot(true);
  soon_->setInterval(kFrame_ms);
  connect(soon_, &QTimer::timeout, this, &BodyView::refresh);
  for (const auto signal : {&BodySolver::naiveChanged, &BodySolver::bodyChanged})
    connect(&solver_, signal, this, &BodyView::refreshSoon);
  connect(&solver_, &BodySolver::stateChanged, this, [this] {
    inspector_->setBody(solver_.body(), solver_.isCurrent());
    inspector_->select(muscle_);
  });
  connect(inspector_, &ChangeInspector::chosen, this, &BodyView::setMuscle);
  connect(view_, &ModelView::picked, this, [this](const std::string& name) {
    if (const auto model = shownModel();
        model && std::ranges::count(model->musculature.units, name, &MusculotendonUnit::name))
      setMuscle(name);
  });
}

QWidget* BodyView::makeView() {
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
  connect(shown_, &QComboBox::currentIndexChanged, this, &BodyView::refreshSoon);
  connect(colouring_, &QComboBox::currentIndexChanged, this, &BodyView::refreshSoon);
  return box;
}

void BodyView::designChanged(bool dragging) {
  dragging_ = dragging;
  fit_wanted_ = true;
  refreshSoon();
}

void BodyView::focusSearch() {
  inspector_->focusSearch();
}

void BodyView::refreshSoon() {
  if (!soon_->isActive()) soon_->start();
}

std::shared_ptr<const Model> BodyView::shownModel() const {
  if (!solver_.reference()) return nullptr;
  if (shown_->currentIndex() == kReference)
    return std::shared_ptr<const Model>{solver_.reference(), &solver_.reference()->model()};
  if (shown_->currentIndex() == kNewest && solver_.isCurrent()) return solver_.body()->model;
  return solver_.naive();
}

void BodyView::refresh() {
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
  if (fit_wanted_ && !dragging_) view_->fit();
  if (solver_.isCurrent()) fit_wanted_ = false;
  curves_->show(solver_.reference(), solver_.naive(), solver_.isCurrent() ? solver_.body() : nullptr, muscle_);
}

void BodyView::setMuscle(const std::string& unit) {
  if (unit == muscle_) return;
  muscle_ = unit;
  inspector_->select(unit);
  refreshSoon();
}

}  // namespace sinew
