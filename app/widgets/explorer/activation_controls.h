#pragma once
#include <QWidget>
#include <vector>

class QComboBox;
class QLabel;
class QSlider;

namespace sinew {

class Explorer;
struct JointMotion;

/// Sets how active muscles are: the chosen one, its group, or all that turn a joint one way; says what torque they
/// make.
class ActivationControls : public QWidget {
  Q_OBJECT
 public:
  explicit ActivationControls(Explorer& explorer, QWidget* parent = nullptr);

 private:
  void fill();
  std::vector<int> targets() const;
  const JointMotion* motion() const;  ///< nullptr: the target is a muscle or its group
  void apply();
  void describe();

  Explorer& explorer_;
  QComboBox* target_;
  QSlider* slider_;
  QLabel *percent_, *effect_;
};

}  // namespace sinew
