#include "app/widgets/retarget/shape_panel.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/parameter_row.h"
#include "app/widgets/controls/theme.h"

namespace sinew {

ShapePanel::ShapePanel(DesignDocument& document, QWidget* parent) : QWidget{parent}, document_{document} {
  setObjectName("shape_panel");
  linked_ = new QCheckBox{tr("Both sides alike")};
  linked_->setObjectName("link_shape_sides");
  linked_->setToolTip(
      tr("A change of one side changes the other one too. Switched on, the left side takes the right one's shape."));
  linked_->setChecked(true);
  auto* reset = makeButton("reset_shape", tr("Reset"), "undo", tr("Back to the shape of the reference"));
  auto* top = new QHBoxLayout;
  top->setContentsMargins(12, 8, 12, 0);
  top->addWidget(linked_);
  top->addStretch();
  top->addWidget(reset);
  auto* all = new QWidget;
  auto* column = new QVBoxLayout{all};
  column->setContentsMargins(12, 2, 8, 10);
  column->setSpacing(3);
  std::string part;
  for (const ShapeField& field : shapeFields()) {
    if (field.part != part) {
      if (!part.empty()) column->addSpacing(7);
      column->addWidget(makeLabel(partTitle(field.part), "heading"));
      part = field.part;
    }
    for (int side = 0; side < (field.isSided() ? 2 : 1); ++side) addRow(field, side, *column);
  }
  column->addStretch();
  auto* scroll = new QScrollArea;
  scroll->setObjectName("shape_scroll");
  scroll->setWidget(all);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* outer = new QVBoxLayout{this};
  outer->setContentsMargins(0, 0, 0, 0);
  outer->setSpacing(4);
  outer->addLayout(top);
  outer->addWidget(scroll, 1);

  connect(linked_, &QCheckBox::toggled, this, &ShapePanel::linkSides);
  connect(reset, &QPushButton::clicked, this,
          [this] { document_.edit(tr("Reset the shape"), [](RetargetDesign& d) { d.body.shape = {}; }); });
  connect(&document_, &DesignDocument::changed, this, &ShapePanel::refresh);
  connect(&document_, &DesignDocument::previewed, this, &ShapePanel::refresh);
  connect(&document_, &DesignDocument::rejected, this, &ShapePanel::refresh);
  refresh();
}

bool ShapePanel::sidesLinked() const {
  return linked_->isChecked();
}

void ShapePanel::addRow(const ShapeField& field, int side, QVBoxLayout& column) {
  const QString suffix = !field.isSided() ? QString{} : side == 0 ? QStringLiteral("_r") : QStringLiteral("_l");
  const QString side_word = !field.isSided() ? QString{} : side == 0 ? tr(", right") : tr(", left");
  const auto slider = sliderRange(field), typed = typedRange(field);
  auto* row =
      new ParameterRow{{QString::fromStdString(field.part) + suffix + '_' + QString::fromStdString(field.quantity),
                        fieldTitle(field), partTitle(field.part) + ' ' + fieldTitle(field) + side_word,
                        fieldMeaning(field), field.unit(), slider.low, slider.high, typed.low, typed.high}};
  const auto set = [this, field, side](double value) {
    return [this, field, side, value](RetargetDesign& d) {
      setShownValue(d.body.shape, field, side, sidesLinked(), value);
    };
  };
  connect(row, &ParameterRow::dragged, this, [=, this](double value) { document_.preview(set(value)); });
  connect(row, &ParameterRow::settled, this, [=, this](double value) {
    document_.edit(tr("%1: %2").arg(partTitle(field.part), fieldTitle(field).toLower()), set(value));
  });
  column.addWidget(row);
  rows_.push_back({field, side, row});
}

void ShapePanel::linkSides(bool linked) {
  if (linked) document_.edit(tr("Make both sides alike"), [](RetargetDesign& d) { mirrorToLeft(d.body.shape); });
  refresh();
}

void ShapePanel::refresh() {
  const ShapeParameters& shape = document_.current().body.shape;
  if (linked_->isChecked() && !hasEqualSides(shape)) {  // a file, or an undone step, with sides of its own
    const QSignalBlocker block{linked_};
    linked_->setChecked(false);
  }
  for (auto& [field, side, row] : rows_) {
    row->setValue(shownValue(shape, field, side));
    if (!field.isSided()) continue;
    row->setVisible(side == 0 || !linked_->isChecked());
    row->setTitle(linked_->isChecked() ? fieldTitle(field) : fieldTitle(field) + (side == 0 ? tr(" R") : tr(" L")));
  }
}

}  // namespace sinew
