#pragma once
#include <QWidget>
#include <array>

#include "app/model/explorer/rom_study.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QTimer;

namespace sinew {

class ColourBar;
class Explorer;
class RomSphereView;

/// The range of a ball joint as spheres: with another joint at two angles, cells counted and compared.
class RomPanel : public QWidget {
  Q_OBJECT
 public:
  RomPanel(Explorer& explorer, RomStudy::Mapper mapper, QWidget* parent = nullptr);

  /// What to show about the joint on the body; nullptr: nothing.
  const RomMap* mapOnBody() const;
  double widest_rad() const { return widest_rad_; }

 signals:
  void mapOnBodyChanged();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void fillJoints();
  void chooseJoint();
  void ask(bool abandon_running);
  void askIfPostureMatters();
  void showAnswer();
  void showShaft();
  RomQuestion question() const;
  QString conditionText(int map) const;

  Explorer& explorer_;
  RomStudy study_;
  QComboBox *joint_, *with_, *on_body_;
  std::array<QDoubleSpinBox*, 2> values_;
  std::array<RomSphereView*, 2> spheres_;
  QLabel* summary_;
  ColourBar* bar_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QTimer* slow_;  ///< progress shows only when it takes long
  double widest_rad_ = 0;
};

}  // namespace sinew
