#pragma once
#include <QWidget>
#include <optional>

#include "app/model/retarget/retarget_design.h"
#include "app/model/retarget/rom_edit_study.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QListWidget;

namespace sinew {

/// Exact figures of the edit of one joint's range of motion, the list of all edits, and their files.
class RomEditPanel : public QWidget {
  Q_OBJECT
 public:
  explicit RomEditPanel(DesignDocument& document, QWidget* parent = nullptr);

  void setSkeleton(std::shared_ptr<const Model> model);
  const std::string& joint() const { return joint_; }
  bool isBall() const;
  void chooseJoint(const std::string& joint);

 signals:
  void jointChosen();
  void problem(const QString& message);
  void notice(const QString& message);

 private:
  QDoubleSpinBox* makeField(const QString& object_name, const QString& spoken, const QString& tip, bool is_angle);
  void apply(const QString& label, const std::function<void(RomEdit&)>& change);
  void applyTilt();
  void loadFile();
  void saveFile();
  void refresh();

  DesignDocument& document_;
  std::shared_ptr<const Model> model_;
  std::string joint_;
  QComboBox *joints_, *towards_;
  QWidget *ball_box_, *hinge_box_;
  QDoubleSpinBox *cone_, *tilt_, *twist_, *twist_shift_, *range_, *shift_;
  QLabel* axis_;
  QListWidget* edits_;
};

}  // namespace sinew
