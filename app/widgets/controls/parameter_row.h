#pragma once
#include <QWidget>

#include "core/skeleton/shape/shape.h"

class QDoubleSpinBox;
class QLabel;

namespace sinew {

class RangeSlider;

/// One number with a slider and a field: a ratio on a logarithmic slider, an angle, or a length. A drag is told apart
/// from what is meant to stay.
class ParameterRow : public QWidget {
  Q_OBJECT
 public:
  struct Look {
    QString name;    ///< of objects: "slider_NAME", "value_NAME"
    QString title;   ///< shown before the slider
    QString spoken;  ///< accessible name
    QString tip;
    ShapeUnit unit = ShapeUnit::Ratio;  ///< shown as ×, ° or mm
    double slider_low = 0.4, slider_high = 3, typed_low = 0.2, typed_high = 4;
  };
  explicit ParameterRow(const Look& look, QWidget* parent = nullptr);

  void setValue(double value);
  double value() const { return value_; }
  void setTitle(const QString& title);

 signals:
  void dragged(double value);  ///< the slider is held down
  void settled(double value);  ///< let go, typed, or moved with the keys

 private:
  int toSlider(double value) const;
  double fromSlider(int position) const;
  void show();

  ShapeUnit unit_;
  double value_ = 0;
  bool dragging_ = false;
  QLabel* title_;
  RangeSlider* slider_;
  QDoubleSpinBox* field_;
};

}  // namespace sinew
