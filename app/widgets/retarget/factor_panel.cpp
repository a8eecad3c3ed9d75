#include "app/widgets/retarget/factor_panel.h"

#include <QComboBox>
#include <QCompleter>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "app/model/retarget/factor_form.h"
#include "app/model/retarget/shape_form.h"
#include "app/model/stage_text.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "core/muscle/musculature.h"

namespace sinew {
namespace {

QDoubleSpinBox* makeFactor(const QString& object_name, const QString& spoken, const QString& tip) {
  auto* field = new PatientSpinBox;
  field->setObjectName(object_name);
  field->setAccessibleName(spoken);
  field->setToolTip(tip);
  field->setKeyboardTracking(false);
  field->setDecimals(2);
  field->setSingleStep(0.05);
  field->setRange(0.01, 100);
  field->setPrefix(QStringLiteral("× "));
  field->setFixedWidth(86);
  return field;
}

}  // namespace

FactorPanel::FactorPanel(DesignDocument& document, QWidget* parent) : QWidget{parent}, document_{document} {
  setObjectName("factor_panel");
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(12, 10, 12, 10);
  column->setSpacing(4);
  column->addWidget(makeMasses());
  column->addSpacing(6);
  column->addWidget(makeStrengths(), 1);
  connect(&document_, &DesignDocument::changed, this, &FactorPanel::refresh);
  refresh();
}

QWidget* FactorPanel::makeMasses() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout{box};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(3);
  column->addWidget(makeLabel(tr("Masses"), "heading"));
  for (const auto& part : massFormParts()) {
    const QString name = QString::fromStdString(part), title = readableName(part);
    auto* rule = new QComboBox;
    rule->setObjectName("mass_rule_" + name);
    rule->setAccessibleName(tr("Mass of the %1 is given").arg(title.toLower()));
    rule->setToolTip(
        tr("As the deformed volume weighs; times that; or over the reference's mass, whatever the volume"));
    rule->addItems({tr("volume"), tr("× volume"), tr("× reference")});
    auto* value = makeFactor("mass_value_" + name, tr("Mass factor of the %1").arg(title.toLower()),
                             tr("Mass of the %1, relative to what is named before").arg(title.toLower()));
    auto* label = makeLabel(title, "");
    label->setFixedWidth(62);
    auto* row = new QHBoxLayout;
    row->setSpacing(4);
    row->addWidget(label);
    row->addWidget(rule, 1);
    row->addWidget(value);
    column->addLayout(row);
    const std::size_t index = masses_.size();
    masses_.push_back({part, rule, value});
    connect(rule, &QComboBox::activated, this, [this, index] { setMass(index); });
    connect(value, &QDoubleSpinBox::valueChanged, this, [this, index] { setMass(index); });
  }
  mass_ = makeLabel({}, "small");
  mass_->setObjectName("whole_mass");
  mass_->setWordWrap(true);
  column->addWidget(mass_);
  return box;
}

QWidget* FactorPanel::makeStrengths() {
  auto* box = new QWidget;
  name_ = new QComboBox;
  name_->setObjectName("strength_name");
  name_->setAccessibleName(tr("Muscle or group"));
  name_->setToolTip(tr("Type a part of the name of a muscle or group"));
  name_->setEditable(true);
  name_->setInsertPolicy(QComboBox::NoInsert);
  name_->completer()->setFilterMode(Qt::MatchContains);
  name_->completer()->setCompletionMode(QCompleter::PopupCompletion);
  name_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  auto* add = makeButton("strength_add", tr("Add"), {}, tr("Give this muscle or group a strength of its own"));
  auto* choose = new QHBoxLayout;
  choose->setSpacing(4);
  choose->addWidget(name_, 1);
  choose->addWidget(add);
  strengths_ = makeTable("strength_table", {tr("Muscle or group"), tr("Force"), {}});
  strengths_->setToolTip(
      tr("Maximal isometric force over the reference's; what is not listed follows the cross-section"));
  strengths_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (const int column : {1, 2}) strengths_->horizontalHeader()->setSectionResizeMode(column, QHeaderView::Fixed);
  strengths_->horizontalHeader()->resizeSection(1, 88);
  strengths_->horizontalHeader()->resizeSection(2, 44);
  strengths_->verticalHeader()->setDefaultSectionSize(36);
  auto* column = new QVBoxLayout{box};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(makeLabel(tr("Strengths"), "heading"));
  column->addLayout(choose);
  column->addWidget(strengths_, 1);
  connect(add, &QPushButton::clicked, this, &FactorPanel::addStrength);
  return box;
}

void FactorPanel::setMusculature(const Musculature& musculature) {
  const QSignalBlocker block{name_};
  name_->clear();
  for (const auto& name : strengthNames(musculature))
    name_->addItem(name == "all" ? tr("All muscles") : readableName(name), QString::fromStdString(name));
}

void FactorPanel::showMass(double mass_kg, double reference_kg) {
  mass_->setText(std::isfinite(mass_kg)
                     ? tr("Whole body %1 kg, the reference %2 kg").arg(figure(mass_kg, 1), figure(reference_kg, 1))
                     : QString{});
}

void FactorPanel::setMass(std::size_t index) {
  const MassRow& row = masses_[index];
  const auto rule = MassRule(row.rule->currentIndex());
  const double value = row.value->value();
  document_.edit(tr("Mass of the %1").arg(readableName(row.part).toLower()),
                 [&](RetargetDesign& d) { setPartMass(d.body.physics, row.part, rule, value); });
  refresh();
}

void FactorPanel::addStrength() {
  const int index = name_->findText(name_->currentText(), Qt::MatchFixedString);
  if (index < 0) return;
  const std::string name = name_->itemData(index).toString().toStdString();
  document_.edit(tr("Strength of %1").arg(name_->itemText(index)),
                 [&](RetargetDesign& d) { d.body.physics.strength_factors.try_emplace(name, 1.0); });
}

void FactorPanel::refresh() {
  for (const auto& row : masses_) {
    const PartMass mass = partMass(document_.current().body.physics, row.part);
    const QSignalBlocker block_rule{row.rule}, block_value{row.value};
    row.rule->setCurrentIndex(int(mass.rule));
    row.value->setValue(mass.value);
    row.value->setEnabled(mass.rule != MassRule::Volume);
    if (mass.mixed) row.rule->setToolTip(tr("Its segments differ; a change here makes them alike"));
  }
  refreshStrengths();
}

void FactorPanel::refreshStrengths() {
  const auto& factors = document_.current().body.physics.strength_factors;
  std::vector<std::string> names;
  for (const auto& [name, factor] : factors) names.push_back(name);
  if (names != shown_) {
    shown_ = names;
    strengths_->setRowCount(int(names.size()));
    for (int row = 0; row < int(names.size()); ++row) {
      const std::string name = names[std::size_t(row)];
      const QString title = name == "all" ? tr("All muscles") : readableName(name);
      setCell(*strengths_, row, 0, title)->setToolTip(title);
      auto* value = makeFactor("strength_" + QString::fromStdString(name), tr("Strength of %1").arg(title),
                               tr("Maximal isometric force of %1 over the reference's").arg(title));
      connect(value, &QDoubleSpinBox::valueChanged, this, [this, name, title](double factor) {
        document_.edit(tr("Strength of %1").arg(title),
                       [&](RetargetDesign& d) { d.body.physics.strength_factors[name] = factor; });
      });
      auto* remove = makeToolButton("strength_remove_" + QString::fromStdString(name), "close",
                                    tr("Let the force of %1 follow its cross-section again").arg(title));
      connect(remove, &QToolButton::clicked, this, [this, name, title] {
        // Later: the button must not go while it is being clicked.
        QMetaObject::invokeMethod(
            this,
            [this, name, title] {
              document_.edit(tr("Remove the strength of %1").arg(title),
                             [&](RetargetDesign& d) { d.body.physics.strength_factors.erase(name); });
            },
            Qt::QueuedConnection);
      });
      strengths_->setCellWidget(row, 1, value);
      strengths_->setCellWidget(row, 2, remove);
    }
  }
  for (int row = 0; row < int(names.size()); ++row) {
    auto* value = qobject_cast<QDoubleSpinBox*>(strengths_->cellWidget(row, 1));
    const QSignalBlocker block{value};
    value->setValue(factors.at(names[std::size_t(row)]));
  }
}

}  // namespace sinew
