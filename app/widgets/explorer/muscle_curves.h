#pragma once
#include <QWidget>
#include <string>

#include "core/posture/evaluate.h"

class QComboBox;
class QLabel;

namespace sinew {

class CurvePlot;
class Explorer;

/// Curves of the chosen muscle: force over fibre length with the operating point, and length and moment arm over a
/// joint motion.
class MuscleCurves : public QWidget {
  Q_OBJECT
 public:
  explicit MuscleCurves(Explorer& explorer, QWidget* parent = nullptr);
  void refresh();

 private:
  void fillMotions();
  void showForceLength(int unit);
  void showMotion();

  Explorer& explorer_;
  QLabel* title_;
  QComboBox* motion_;
  CurvePlot *force_, *length_, *arm_;
  std::string curve_key_;  ///< what curve_ belongs to
  MotionCurve curve_;
  const void* filled_for_ = nullptr;
};

}  // namespace sinew
