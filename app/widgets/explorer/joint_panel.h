#pragma once
#include <QWidget>
#include <vector>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QScrollArea;
class QVBoxLayout;

namespace sinew {

class Explorer;
class RangeSlider;

/// All coordinates of the posture, joint by joint: slider, typed value, norm, envelope and what muscles leave; preset
/// postures, mirror, reset.
class JointPanel : public QWidget {
  Q_OBJECT
 public:
  explicit JointPanel(Explorer& explorer, QWidget* parent = nullptr);

 private:
  struct Row {
    int coordinate;
    double scale;  ///< shown unit per radian or metre
    RangeSlider* slider;
    QDoubleSpinBox* value;
    QLabel* range;
  };
  void build();
  QWidget* makeJoint(int joint);
  QWidget* makeRow(int coordinate);
  QString passiveText(int coordinate) const;
  void showPosture();
  void showRanges();

  Explorer& explorer_;
  QComboBox *presets_, *joints_;
  QCheckBox* linked_;
  QScrollArea* scroll_;
  std::vector<QWidget*> sections_;
  std::vector<Row> rows_;
};

}  // namespace sinew
