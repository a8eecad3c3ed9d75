#include "app/widgets/controls/parameter_row.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/range_slider.h"
#include "app/widgets/controls/theme.h"

namespace sinew {
namespace {
constexpr double kPerTurn = 1000;  // slider steps for a factor of e
constexpr double kPerUnit = 10;    // degree or millimetre
}  // namespace

ParameterRow::ParameterRow(const Look& look, QWidget* parent) : QWidget{parent}, unit_{look.unit} {
  title_ = makeLabel(look.title, "");
  title_->setFixedWidth(84);
  title_->setToolTip(look.tip);
  slider_ = new RangeSlider;
  slider_->setObjectName("slider_" + look.name);
  slider_->setAccessibleName(look.spoken);
  slider_->setToolTip(look.tip);
  slider_->setFixedHeight(22);
  slider_->setMinimumWidth(76);
  slider_->setRange(toSlider(look.slider_low), toSlider(look.slider_high));
  field_ = new PatientSpinBox;
  field_->setObjectName("value_" + look.name);
  field_->setAccessibleName(look.spoken);
  field_->setToolTip(look.tip);
  field_->setKeyboardTracking(false);
  const bool ratio = unit_ == ShapeUnit::Ratio;
  field_->setDecimals(ratio ? 2 : 1);
  field_->setSingleStep(ratio ? 0.05 : 1);
  field_->setRange(look.typed_low, look.typed_high);
  if (ratio)
    field_->setPrefix(QStringLiteral("× "));
  else
    field_->setSuffix(unit_ == ShapeUnit::Angle ? QStringLiteral("°") : QStringLiteral(" mm"));
  field_->setFixedWidth(86);
  auto* row = new QHBoxLayout{this};
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  row->addWidget(title_);
  row->addWidget(slider_, 1);
  row->addWidget(field_);
  value_ = ratio ? 1 : 0;
  show();

  connect(slider_, &QAbstractSlider::valueChanged, this, [this](int position) {
    value_ = fromSlider(position);
    show();
    if (slider_->isSliderDown()) {
      dragging_ = true;
      emit dragged(value_);
    } else {
      emit settled(value_);
    }
  });
  connect(slider_, &QAbstractSlider::sliderReleased, this, [this] {
    if (!dragging_) return;
    dragging_ = false;
    emit settled(value_);
  });
  connect(field_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    value_ = value;
    show();
    emit settled(value_);
  });
}

int ParameterRow::toSlider(double value) const {
  return int(std::lround(unit_ == ShapeUnit::Ratio ? kPerTurn * std::log(value) : kPerUnit * value));
}

double ParameterRow::fromSlider(int position) const {
  if (unit_ != ShapeUnit::Ratio) return position / kPerUnit;
  return std::round(100 * std::exp(position / kPerTurn)) / 100;  // hundredths, as the field shows
}

void ParameterRow::setValue(double value) {
  if (dragging_) return;  // the hand knows better
  value_ = value;
  show();
}

void ParameterRow::setTitle(const QString& title) {
  title_->setText(title);
}

void ParameterRow::show() {
  const QSignalBlocker block_slider{slider_}, block_field{field_};
  const int position = toSlider(value_);
  if (!slider_->isSliderDown()) slider_->setValue(position);
  const int shown = slider_->value();
  slider_->setFree(std::pair{std::min(0, shown), std::max(0, shown)});
  slider_->update();
  field_->setValue(value_);
}

}  // namespace sinew
