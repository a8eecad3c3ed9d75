#pragma once
#include <QFrame>

#include "app/model/retarget/body_solver.h"

class QProgressBar;
class QPushButton;

namespace sinew {

class ElidedLabel;

/// What is shown at present - naive or retargeted muscles, how long it took, why not -, with progress and a way to
/// stop.
class SolverState : public QFrame {
  Q_OBJECT
 public:
  explicit SolverState(BodySolver& solver, QWidget* parent = nullptr);

 private:
  void refresh();

  BodySolver& solver_;
  ElidedLabel* state_;
  QProgressBar* progress_;
  QPushButton* cancel_;
};

}  // namespace sinew
