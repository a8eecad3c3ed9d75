#pragma once
#include <QWidget>

class QLabel;
class QScrollArea;

namespace sinew {

class Explorer;

/// Everything about the chosen muscle in words and figures; follows the posture.
class MuscleCard : public QWidget {
  Q_OBJECT
 public:
  explicit MuscleCard(Explorer& explorer, QWidget* parent = nullptr);
  void refresh();

 private:
  Explorer& explorer_;
  QLabel *title_, *subtitle_, *facts_;
  QScrollArea* scroll_;
};

}  // namespace sinew
