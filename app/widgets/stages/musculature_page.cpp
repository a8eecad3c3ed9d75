#include "app/widgets/stages/musculature_page.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/views/model_view.h"
#include "core/angle.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kSmallestArm_m = 0.001;  // arms below a millimetre only crowd the card

double lengthFactor(const Model& model, const std::string& unit) {
  const auto found = model.length_factors.find(unit);
  return found == model.length_factors.end() ? 1.0 : found->second;
}

/// What the card says of a unit at the patient's posture on the radiographs.
std::vector<std::pair<QString, QString>> factsOf(const Model& model, const MusculotendonUnit& unit,
                                                 const Posture& q) {
  const Kinematics clinical = clinicalKinematics(model.skeleton, q);
  const double length_m = pathLength(unit, clinical.X_WB);
  const FiberState state = equilibrium(unit, length_m, 0);
  std::vector<std::pair<QString, QString>> facts{
      {QObject::tr("Isometric force"), figure(unit.max_isometric_force_N, 0) + " N"},
      {QObject::tr("Optimal fibre length"), figure(1000 * unit.optimal_fiber_length_m, 1) + " mm"},
      {QObject::tr("Tendon slack length"), figure(1000 * unit.tendon_slack_length_m, 1) + " mm"},
      {QObject::tr("Pennation"), figure(unit.pennation_angle_at_optimal_rad / kRadPerDeg, 1) + "°"},
      {QObject::tr("Exam length factor"), figure(lengthFactor(model, unit.name), 3)},
      {QObject::tr("Path length, on the images"), figure(1000 * length_m, 1) + " mm"},
      {QObject::tr("Fibre / optimum"), figure(state.normalized_fiber_length, 2)},
      {QObject::tr("Passive force"), figure(state.force_N, 0) + " N"}};
  const Eigen::VectorXd arms_m = momentArms(unit, clinical);
  for (Eigen::Index i = 0; i < arms_m.size(); ++i) {
    const Coordinate& coordinate = model.skeleton.coordinates[std::size_t(i)];
    if (!coordinate.translational && coordinate.joint != 0 && std::abs(arms_m[i]) >= kSmallestArm_m)
      facts.emplace_back(
          QObject::tr("Moment arm, %1").arg(readableName(coordinate.name).section(',', 0, 0).toLower()),
          figure(1000 * arms_m[i], 1) + " mm");
  }
  return facts;
}

}  // namespace

MusculaturePage::MusculaturePage(Workspace& workspace)
    : StagePage{workspace, Stage::Musculature, tr("Muscles carried to this patient's bones.")} {
  auto* list = new QVBoxLayout;
  list->setSpacing(8);
  search_ = makeSearchField("muscle_search", tr("Find a muscle or group"));
  count_ = makeLabel({}, "small");
  count_->setObjectName("muscle_count");
  table_ = makeTable("muscle_table", {tr("Muscle"), tr("Force N"), tr("Factor")});
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (int column = 1; column < 3; ++column)
    table_->horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  table_->setAccessibleName(tr("Muscles"));
  list->addWidget(search_);
  list->addWidget(count_);
  list->addWidget(table_, 1);
  auto* list_box = new QWidget;
  list->setContentsMargins(0, 0, 0, 0);
  list_box->setLayout(list);

  model_view_ = new ModelView{"muscle_model", true};
  auto* card = new Card;
  title_ = makeLabel({}, "heading");
  title_->setObjectName("muscle_title");
  title_->setWordWrap(true);
  subtitle_ = makeLabel({}, "small");
  subtitle_->setObjectName("muscle_subtitle");
  subtitle_->setWordWrap(true);
  facts_ = makeTable("muscle_facts", {tr("Property"), tr("Value")});
  facts_->horizontalHeader()->hide();
  facts_->setSelectionMode(QAbstractItemView::NoSelection);
  facts_->setFrameShape(QFrame::NoFrame);
  facts_->setStyleSheet("border: none;");
  wrapRows(*facts_);
  facts_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  facts_->horizontalHeader()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  card->content().addWidget(title_);
  card->content().addWidget(subtitle_);
  card->content().addWidget(facts_, 1);
  card->setFixedWidth(270);

  auto* row = new QHBoxLayout;
  row->setSpacing(12);
  row->addWidget(list_box, 5);
  row->addWidget(model_view_, 7);
  row->addWidget(card);
  body().addLayout(row, 1);

  connect(search_, &QLineEdit::textChanged, this, &MusculaturePage::filterRows);
  connect(table_, &QTableWidget::currentCellChanged, this, [this](int index) {
    if (index >= 0 && table_->item(index, 0))
      this->workspace().view().setMuscle(table_->item(index, 0)->data(Qt::UserRole).toString().toStdString());
  });
  connect(model_view_, &ModelView::picked, &workspace.view(), &ViewState::setMuscle);
  connect(&workspace.view(), &ViewState::muscleChanged, this, [this] {
    if (isVisible()) showMuscle();
  });
}

void MusculaturePage::refresh() {
  const auto model = workspace().patientModel();
  model_view_->setModel(model, model ? shownCase().skeleton->posture : Posture{}, tr("Fit the skeleton first."));
  if (model != listed_) {
    listed_ = model;
    const QSignalBlocker block{table_};
    table_->setRowCount(0);
    if (model) fillTable(*model);
  }
  filterRows();
  showMuscle();
}

void MusculaturePage::fillTable(const Model& model) {
  const auto& units = model.musculature.units;
  table_->setRowCount(int(units.size()));
  for (int i = 0; i < int(units.size()); ++i) {
    const auto& unit = units[std::size_t(i)];
    auto* name = setCell(*table_, i, 0, readableName(unit.name));
    name->setData(Qt::UserRole, QString::fromStdString(unit.name));
    name->setData(Qt::UserRole + 1, readableName(unit.group));
    name->setToolTip(readableName(unit.group));
    setCell(*table_, i, 1, figure(unit.max_isometric_force_N, 0), kNumber);
    const double factor = lengthFactor(model, unit.name);
    auto* cell = setCell(*table_, i, 2, factor == 1 ? "1" : figure(factor, 2), kNumber);
    if (factor != 1) cell->setForeground(colour::kPrimaryDark);
  }
}

void MusculaturePage::filterRows() {
  const QString wanted = search_->text().trimmed();
  int shown = 0;
  for (int i = 0; i < table_->rowCount(); ++i) {
    const auto* item = table_->item(i, 0);
    const bool match = wanted.isEmpty() || item->text().contains(wanted, Qt::CaseInsensitive) ||
                       item->data(Qt::UserRole + 1).toString().contains(wanted, Qt::CaseInsensitive);
    table_->setRowHidden(i, !match);
    shown += match;
  }
  count_->setText(shown == table_->rowCount()
                      ? tr("%1 musculotendon units").arg(shown)
                      : tr("%1 of %2 musculotendon units").arg(shown).arg(table_->rowCount()));
}

void MusculaturePage::showMuscle() {
  const auto model = workspace().patientModel();
  const std::string& name = workspace().view().muscle();
  const auto* units = model ? &model->musculature.units : nullptr;
  const auto found = units ? std::ranges::find(*units, name, &MusculotendonUnit::name)
                           : std::vector<MusculotendonUnit>::const_iterator{};
  model_view_->select(name);
  facts_->setRowCount(0);
  if (!units || found == units->end()) {
    title_->setText(name.empty() ? tr("No muscle chosen") : readableName(name));
    subtitle_->setText(tr("Choose one in the list or in the model."));
    return;
  }
  const int row = int(found - units->begin());
  if (table_->currentRow() != row) {
    const QSignalBlocker block{table_};
    table_->setCurrentCell(row, 0);
  }
  title_->setText(readableName(name));
  subtitle_->setText(
      tr("Group: %1\nSource: %2").arg(readableName(found->group), QString::fromStdString(found->source)));
  const auto facts = factsOf(*model, *found, shownCase().skeleton->posture);
  facts_->setRowCount(int(facts.size()));
  for (int i = 0; i < int(facts.size()); ++i) {
    setCell(*facts_, i, 0, facts[std::size_t(i)].first)->setToolTip(facts[std::size_t(i)].first);
    setCell(*facts_, i, 1, facts[std::size_t(i)].second, kNumber);
  }
  facts_->resizeRowsToContents();
}

}  // namespace sinew
