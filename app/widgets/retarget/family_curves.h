#pragma once
#include <QWidget>
#include <memory>
#include <string>

#include "app/model/retarget/body_solver.h"

class QComboBox;
class QLabel;

namespace sinew {

class CurvePlot;

/// Length, moment arm and torque of one muscle over a joint motion: in the reference, moved with the bones,
/// retargeted.
class FamilyCurves : public QWidget {
  Q_OBJECT
 public:
  explicit FamilyCurves(QWidget* parent = nullptr);

  /// `body` may be nullptr, or of an older design (`naive_model` is always of the newest): then it is left out.
  void show(std::shared_ptr<const RetargetReference> reference, std::shared_ptr<const Model> naive,
            std::shared_ptr<const SolvedBody> body, const std::string& unit);

 private:
  void fillMotions();
  void draw();
  const JointMotion* chosenMotion() const;

  std::shared_ptr<const RetargetReference> reference_;
  std::shared_ptr<const Model> naive_;
  std::shared_ptr<const SolvedBody> body_;
  std::string unit_;
  QLabel* title_;
  QComboBox* motion_;
  CurvePlot *length_, *arm_, *torque_;
};

}  // namespace sinew
